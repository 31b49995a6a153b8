#include "cli/project_runs.h"

#include <algorithm>

#include "core/error.h"

namespace eyrie::cli {

RunRecord chosenRun(const RunStore& store, const std::string& project, std::optional<int> id,
                    const std::string& option) {
    const std::vector<RunRecord> runs = store.runs();
    if (runs.empty()) throw Error(ErrorKind::project, project + ": holds no run; make one with eyrie-cli run");
    if (!id) {
        // Another program may just have begun one.
        const auto last =
            std::find_if(runs.rbegin(), runs.rend(), [](const RunRecord& run) { return run.frames_done > 0; });
        return last == runs.rend() ? runs.back() : *last;
    }
    std::string known;
    for (const RunRecord& run : runs) {
        if (run.id == *id) return run;
        known += (known.empty() ? "" : ", ") + std::to_string(run.id);
    }
    throw Error(ErrorKind::parameter, option + " " + std::to_string(*id) + ": " + project + " holds the runs " + known);
}

}  // namespace eyrie::cli
