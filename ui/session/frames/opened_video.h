#pragma once

#include <cstdint>
#include <vector>

#include "io/video/frame_source.h"
#include "session/project/media.h"
#include "store/runs/run_store.h"

namespace eyrie::ui {

/// What is known of a video once it is open.
struct OpenedVideo {
    VideoInfo info;
    std::vector<std::int64_t> times_us;  ///< presentation time of every frame
    double gsd_m_per_px = 0;             ///< 0: the video does not tell
};

/// What a project knows of a video that cannot be opened: its frames at even times.
OpenedVideo videoNotThere(const SequenceRecord& sequence);

/// A video as a project keeps it.
SequenceRecord sequenceOf(const Media& media, const VideoInfo& video);

}  // namespace eyrie::ui
