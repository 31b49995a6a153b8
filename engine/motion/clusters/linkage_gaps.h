#pragma once

#include <vector>

#include "motion/clusters/clustering_trace.h"
#include "motion/clusters/single_linkage.h"

namespace eyrie {

/// The two vectors as the linkage sees them; `parameter` stays empty.
LinkageGap gapBetween(const MotionVector& a, const MotionVector& b, const Linkage& linkage);

/// The smallest gap from a group of motion vectors to one outside.
LinkageGap smallestGapOutside(const std::vector<MotionVector>& vectors, const std::vector<int>& group,
                              const Linkage& linkage);

/// The largest gap inside a group along its spanning links: what held it together last. `other` is −1 where there is
/// none.
LinkageGap largestGapInside(const std::vector<MotionVector>& vectors, const std::vector<int>& group,
                            const Linkage& linkage);

}  // namespace eyrie
