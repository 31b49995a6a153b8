#include "cli/project_runs.h"

#include <algorithm>
#include <cstdio>

#include "core/error.h"
#include "core/text.h"

namespace eyrie::cli {

std::string runText(const RunRecord& run) {
    const std::string& name = run.name.empty() ? run.preset : run.name;
    return "run " + std::to_string(run.id) + (name.empty() ? "" : " (" + displayText(name) + ")");
}

RunRecord chosenRun(const RunStore& store, const std::string& project, std::optional<int> id,
                    const std::string& option) {
    const std::vector<RunRecord> runs = store.runs();
    if (runs.empty()) throw Error(ErrorKind::project, project + ": holds no run; make one with eyrie-cli run");
    if (!id) {
        // Another program may just have begun one.
        const auto last =
            std::find_if(runs.rbegin(), runs.rend(), [](const RunRecord& run) { return run.frames_done > 0; });
        const RunRecord& run = last == runs.rend() ? runs.back() : *last;
        if (runs.size() > 1)
            std::fprintf(stderr, "eyrie-cli: taking %s, the last of %zu in %s; %s takes another\n",
                         runText(run).c_str(), runs.size(), project.c_str(), option.c_str());
        return run;
    }
    std::string known;
    for (const RunRecord& run : runs) {
        if (run.id == *id) return run;
        known += (known.empty() ? "" : ", ") + std::to_string(run.id);
    }
    throw Error(ErrorKind::parameter,
                option + " " + std::to_string(*id) + ": " + project +
                    (runs.size() == 1 ? " holds run " + known + " alone" : " holds the runs " + known));
}

}  // namespace eyrie::cli
