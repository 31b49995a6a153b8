#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/geometry/oriented_box.h"

namespace eyrie {

/// Motion vectors that move together (Teutsch §4.2), or an area that a difference image shows to move (§2.2): a first
/// hypothesis of an object.
struct MotionCluster {
    OrientedBox box;             ///< around its motion vectors or moving points, turned to the velocity
    cv::Point2d velocity{0, 0};  ///< px/frame relative to the ground, mean over the members; 0 where there are none
    std::vector<int> members;    ///< indices into FrameMotion::motion_vectors, ascending
    std::vector<cv::Point2f> moving_points{};  ///< px; points of the area in a difference image, else empty
};

}  // namespace eyrie
