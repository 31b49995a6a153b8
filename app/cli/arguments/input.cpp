#include "cli/arguments/input.h"

#include <utility>

#include "cli/reports/console_progress.h"
#include "scene/scene_source.h"
#include "store/labels/annotation_store.h"

namespace eyrie::cli {
double rememberedRate(const std::filesystem::path& project, const std::string& input) {
    std::error_code failure;
    if (!std::filesystem::exists(project, failure)) return 0;
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    for (const SequenceRecord& sequence : sequencesOf(file))
        if (std::filesystem::equivalent(sequence.path, input, failure)) return sequence.rememberedRate();
    return 0;
}

std::unique_ptr<FrameSource> openInput(const std::string& input, double frame_rate_hz, std::stop_token stop,
                                       double remembered_rate_hz) {
    const std::string prefix = "scene:";
    if (input.rfind(prefix, 0) == 0) return openScene(input.substr(prefix.size()));
    SourceOptions options;
    options.frame_rate_hz = frame_rate_hz;
    options.remembered_rate_hz = remembered_rate_hz;
    ConsoleProgress progress("% indexed");
    return openSource(
        input, options, [&](double share) { progress.showShare(share); }, std::move(stop));
}

}  // namespace eyrie::cli
