#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/motion_vector.h"
#include "core/oriented_box.h"
#include "motion/single_linkage.h"

namespace eyrie {

/// Motion vectors that lie close and move alike.
struct VectorGroup {
    OrientedBox box;             ///< around the vectors, along their motion
    cv::Point2d velocity{0, 0};  ///< mean, px/frame
    std::vector<int> members;    ///< indices into the frame's vectors, ascending
};

/// Groups by single linkage of those of the vectors whose indices are chosen, in the order of their first members.
std::vector<VectorGroup> groupVectors(const std::vector<MotionVector>& vectors, const std::vector<int>& chosen,
                                      const Linkage& linkage);

}  // namespace eyrie
