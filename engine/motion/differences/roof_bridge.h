#pragma once

#include <vector>

#include "core/values/motion_vector.h"
#include "motion/clusters/single_linkage.h"

namespace eyrie {

/// How far a plain roof may reach between two motion vectors.
struct RoofBridge {
    double length = 20;     ///< px along the motion, at the centre of the linkage's slope
    double half_width = 2;  ///< px, of the strip between the two vectors that must be free of standing corners; there
};

/// Long vehicles with plain roofs carry corners at the front and at the rear only, farther apart than two cars one
/// behind the other. Between two cars one sees the road, and its corners stand still. So groups are joined where two of
/// their vectors lie in the longer reach, move twice as alike as `linkage` asks, and no standing corner lies between
/// them. `numbers`: group of every vector; the result is numbered from 0 in the order of the groups' first vectors.
std::vector<int> joinAcrossRoofs(const FrameMotion& motion, const Linkage& linkage, const RoofBridge& bridge,
                                 std::vector<int> numbers);

}  // namespace eyrie
