#include "exchange/run_export.h"

#include <algorithm>

#include "core/error.h"
#include "exchange/project_world.h"
#include "formats/label_formats.h"
#include "store/project/video_start.h"
#include "store/review/control_points.h"

namespace eyrie {
namespace {

bool tellsWorld(const std::string& format) {
    const auto& formats = labelFormats();
    return format == kVmtiFormat || std::any_of(formats.begin(), formats.end(), [&](const LabelFormatInfo& info) {
               return info.name == format && info.tells_world;
           });
}

}  // namespace

std::unique_ptr<FrameSource> openVideoFor(const std::string& format, const RunRecord& run, const OpenVideo& open,
                                          const std::stop_token& stop) {
    if (!tellsWorld(format)) return nullptr;
    const bool needed = format == kVmtiFormat;
    std::unique_ptr<FrameSource> video;
    try {
        video = open();
    } catch (const Error&) {
        // Boxes can be written without it; what needs times or places on the earth says so.
        if (needed || stop.stop_requested()) throw;
    }
    if (needed && !video) throw Error(ErrorKind::input, run.sequence.path + ": the video is needed for this format");
    return video;
}

void addWorld(LabelStream& labels, const std::string& format, ProjectFile& project, const RunRecord& run,
              const FrameSource* video, std::optional<std::int64_t> start_utc_us, const std::stop_token& stop) {
    if (!tellsWorld(format)) return;
    const auto start = videoStartOf(project, run.sequence.id, start_utc_us);
    labels.about.world =
        trackWorldOf(RunStore(project), run, video, start, stop, readControlPoints(project, run.sequence.id));
    if (stop.stop_requested())
        throw Error(ErrorKind::input, run.sequence.path + ": stopped while reading its metadata");
}

}  // namespace eyrie
