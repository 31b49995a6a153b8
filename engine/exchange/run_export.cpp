#include "exchange/run_export.h"

#include <algorithm>

#include "core/error.h"
#include "exchange/project_world.h"
#include "formats/label_formats.h"
#include "store/project/video_start.h"
#include "store/review/control_points.h"

namespace eyrie {

bool tellsWorld(const std::string& format) {
    const auto& formats = labelFormats();
    return format == kVmtiFormat || std::any_of(formats.begin(), formats.end(), [&](const LabelFormatInfo& info) {
               return info.name == format && info.tells_world;
           });
}

void addWorld(LabelStream& labels, ProjectFile& project, const RunRecord& run, const FrameSource* pixels,
              std::optional<std::int64_t> start_utc_us, const std::stop_token& stop) {
    const auto start = videoStartOf(project, run.sequence.id, start_utc_us);
    labels.about.world =
        trackWorldOf(RunStore(project), run, pixels, start, stop, readControlPoints(project, run.sequence.id));
    if (stop.stop_requested())
        throw Error(ErrorKind::input, run.sequence.path + ": stopped while reading its metadata");
}

}  // namespace eyrie
