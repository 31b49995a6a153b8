#pragma once

#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/motion_cluster.h"
#include "core/values/motion_vector.h"

/// What of motion vectors and clusters belongs to a place, for all who tell what became of it.
namespace eyrie {

constexpr double kOutlineMargin_px = 1;  ///< corners lie on outlines: so far outside a box they belong to it

/// Indices of the motion vectors in a box, ascending.
std::vector<int> vectorsAtPlace(const OrientedBox& place, const FrameMotion& motion);

/// Indices of the clusters that have motion vectors in a box, those with most first. Of clusters without any, which
/// come from difference images, those whose box means the place: the moving pixels are not stored.
std::vector<int> clustersAtPlace(const OrientedBox& place, const FrameMotion& motion,
                                 const std::vector<MotionCluster>& clusters);

}  // namespace eyrie
