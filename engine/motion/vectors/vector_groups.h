#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "motion/clusters/single_linkage.h"

namespace eyrie {

/// Motion vectors that lie close and move alike.
struct VectorGroup {
    OrientedBox box;             ///< around the vectors, along their motion
    cv::Point2d velocity{0, 0};  ///< mean, px/frame
    std::vector<int> members;    ///< indices into the frame's vectors, ascending
};

/// Lowest linkage distance at any scale, px: corners are at least 2 px apart.
inline constexpr double kSmallestLinkage = 4;

/// What links the vectors of one vehicle in a frame whose background moves with this deviation (px/frame). Velocities
/// may differ by `velocity_share` of the speed.
Linkage vehicleLinkage(const SceneScale& scale, double background_speed_sigma, double velocity_share);

/// Groups by single linkage of those of the vectors whose indices are chosen, in the order of their first members.
std::vector<VectorGroup> groupVectors(const std::vector<MotionVector>& vectors, const std::vector<int>& chosen,
                                      const Linkage& linkage);

}  // namespace eyrie
