#include "cli/arguments/input.h"

#include <utility>

#include "cli/reports/console_progress.h"
#include "core/error.h"
#include "io/live/live_address.h"
#include "io/video/parts/part_list.h"
#include "io/video/parts/part_source.h"
#include "scene/scene_source.h"
#include "store/labels/annotation_store.h"

namespace eyrie::cli {

double rememberedRate(const std::filesystem::path& project, const std::string& input) {
    std::error_code failure;
    if (project.empty() || !std::filesystem::exists(project, failure)) return 0;
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    for (const SequenceRecord& sequence : sequencesOf(file))
        if (std::filesystem::equivalent(sequence.path, input, failure)) return sequence.rememberedRate();
    return 0;
}

std::unique_ptr<FrameSource> openInput(const std::string& input, double frame_rate_hz, std::stop_token stop,
                                       double remembered_rate_hz) {
    if (isScene(input)) return openScene(sceneOf(input));
    SourceOptions options;
    options.frame_rate_hz = frame_rate_hz;
    options.remembered_rate_hz = remembered_rate_hz;
    ConsoleProgress progress("% indexed");
    return openSource(
        input, options, [&](double share) { progress.showShare(share); }, std::move(stop));
}

std::unique_ptr<FrameSource> openInputs(const std::vector<std::string>& inputs, double frame_rate_hz,
                                        const std::stop_token& stop, const std::filesystem::path& project) {
    if (inputs.size() == 1)
        return openInput(inputs.front(), frame_rate_hz, stop, rememberedRate(project, inputs.front()));
    for (const std::string& input : inputs)
        if (isScene(input) || isLiveAddress(input))
            throw Error(ErrorKind::parameter,
                        input + ": only video files can be several parts of one video; give it alone");
    std::vector<std::filesystem::path> places;
    if (!project.empty()) places.push_back(std::filesystem::path(project).replace_extension(kPartListEnding));
    SourceOptions options;
    options.frame_rate_hz = frame_rate_hz;
    auto source = [&] {
        ConsoleProgress progress("% indexed");
        return openTogether(
            {inputs.begin(), inputs.end()}, places, options, [&](double share) { progress.showShare(share); }, stop);
    }();
    if (project.empty() || frame_rate_hz > 0) return source;
    const std::string list = source->info().path.string();
    options.remembered_rate_hz = rememberedRate(project, list);
    if (overridingRate(options, source->info().frame_rate_hz) <= 0) return source;
    return openSource(list, options, {}, stop);
}

}  // namespace eyrie::cli
