#pragma once

#include <array>
#include <vector>

#include "core/values/detection.h"
#include "core/values/dropped_state.h"
#include "core/values/motion_cluster.h"
#include "core/values/motion_vector.h"
#include "core/values/track_state.h"

namespace eyrie {

/// The parts of the chain whose time is measured.
enum class Stage {
    read,
    corners,
    tracking_corners,
    homography,
    motion,
    clustering,
    stacking,
    detection,
    removal,
    tracking,
    store
};
inline constexpr int kStageCount = 11;
/// The word used in files and on screen, e.g. "corner tracking".
const char* nameOf(Stage stage);

/// Wall-clock milliseconds per stage of one frame; 0 where a stage did not run.
using StageTimes = std::array<float, kStageCount>;

/// Everything the chain found in one frame. Shared between threads, never changed once published.
struct FrameResult {
    FrameMotion motion;
    std::vector<MotionCluster> clusters;
    std::vector<OrientedBox> rois;      ///< extended clusters that a detector searched
    std::vector<Detection> detections;  ///< kept and rejected ones; see Detection::rejection
    std::vector<TrackState> tracks;     ///< every living track, tentative ones too; ascending id
    std::vector<DroppedState> dropped;  ///< of stored, finished runs: what was left out of the tracks here
    StageTimes stage_ms{};
};

}  // namespace eyrie
