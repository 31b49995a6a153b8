#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/geometry/oriented_box.h"

namespace eyrie {

/// How far apart the corners of two boxes are at most, px.
inline double cornerDistance(const OrientedBox& a, const OrientedBox& b) {
    const auto p = a.corners();
    const auto q = b.corners();
    double worst = 0;
    for (std::size_t i = 0; i < p.size(); ++i) worst = std::max(worst, std::hypot(p[i].x - q[i].x, p[i].y - q[i].y));
    return worst;
}

}  // namespace eyrie
