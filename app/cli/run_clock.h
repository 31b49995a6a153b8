#pragma once

#include <stop_token>
#include <string>

#include "events/event_csv.h"
#include "georeference/video_clock.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"

namespace eyrie::cli {

/// When the frames of a run were taken: as `start` (--start) says, else as the project keeps it; else, if `ask_video`,
/// as the metadata of the video or its file say. The latter reads through the video; where it cannot be read nobody
/// knows. Throws Error(parameter | project), and what reading was stopped with.
VideoClock clockOf(ProjectFile& project, const RunRecord& run, const std::string& start, bool ask_video,
                   const std::stop_token& stop);

/// The moments of frames by such a clock, to the millisecond; no function for a clock that knows nothing. `seconds`
/// tells when in the video a frame is shown; both are kept.
FrameMoment momentsBy(VideoClock clock, FrameClock seconds);

}  // namespace eyrie::cli
