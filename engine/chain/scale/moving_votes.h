#pragma once

#include <vector>

#include "core/values/frame.h"
#include "core/values/motion_vector.h"
#include "detection/sliding_window/scale_votes.h"
#include "motion/clusters/motion_clustering.h"

namespace eyrie {

/// At what scales that which moves in a frame looks like vehicles.
std::vector<ScaleVote> votesIn(const Frame& frame, const FrameMotion& motion, const MotionClustering& clustering,
                               const ScaleLooker& looker, const ScaleRange& scales);

}  // namespace eyrie
