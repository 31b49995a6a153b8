#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/oriented_box.h"

namespace eyrie {

/// Motion vectors that move together (Teutsch §4.2): a first hypothesis of an object.
struct MotionCluster {
    OrientedBox box;             ///< around its motion vectors, turned to the velocity
    cv::Point2d velocity{0, 0};  ///< px/frame relative to the ground, mean over the members
    std::vector<int> members;    ///< indices into FrameMotion::motion_vectors, ascending
};

}  // namespace eyrie
