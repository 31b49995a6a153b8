#include "cli/arguments/input.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "cli/reports/console_progress.h"
#include "cli/reports/figure_text.h"
#include "core/error.h"
#include "scene/scene_source.h"
#include "store/labels/annotation_store.h"

namespace eyrie::cli {
namespace {

bool readFrameNumber(const std::string& text, FrameIndex& value) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end && value >= 0;
}

}  // namespace

double rememberedRate(const std::filesystem::path& project, const std::string& input) {
    std::error_code failure;
    if (!std::filesystem::exists(project, failure)) return 0;
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    for (const SequenceRecord& sequence : sequencesOf(file))
        if (std::filesystem::equivalent(sequence.path, input, failure)) return sequence.frame_rate_hz;
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

void checkGsd(double gsd) {
    if (!(gsd >= 0.001 && gsd <= 100)) {
        throw Error(ErrorKind::parameter,
                    "--gsd " + numberText(gsd) +
                        ": expected metres per pixel from 0.001 to 100, e.g. 0.3; leave it out when unknown");
    }
}

void checkFrameRate(double rate) {
    if (!(std::isfinite(rate) && rate > 0 && rate <= 10000)) {
        throw Error(ErrorKind::parameter,
                    "--fps " + numberText(rate) + ": expected frames per second above 0, e.g. 25");
    }
}

ParsedRange parseFrames(const std::string& text) {
    ParsedRange range;
    const auto colon = text.find(':');
    const std::string first = text.substr(0, colon);
    const std::string last = colon == std::string::npos ? first : text.substr(colon + 1);
    const bool good = (first.empty() || readFrameNumber(first, range.first)) &&
                      (last.empty() || readFrameNumber(last, range.last)) && !text.empty() &&
                      (range.last < 0 || range.first <= range.last);
    if (!good) {
        throw Error(ErrorKind::parameter,
                    "--frames " + text + ": expected FIRST:LAST, both included and from 0, e.g. 100:249, 100: or :249");
    }
    return range;
}

}  // namespace eyrie::cli
