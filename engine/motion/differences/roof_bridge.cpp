#include "motion/differences/roof_bridge.h"

#include <algorithm>
#include <cmath>

#include "motion/clusters/neighbour_grid.h"
#include "motion/clusters/union_find.h"

namespace eyrie {
namespace {

constexpr double kMoreAlike = 0.5;  ///< of the velocity difference that links neighbours
constexpr double kExpected = 0.4;  ///< standing corners in the gap, were it road like its surroundings; fewer: no proof
constexpr double kThinnestStrip = 1;  ///< px
constexpr double kVehicleEnd = 1.5;   ///< px: corners of the road next to a vehicle lie this close to its own

/// Whether something hides the road between two places: no corner stands there though the surroundings have enough
/// that one might be expected. Where the ground has hardly any corners, as at night, their absence says nothing.
bool roadIsHidden(const std::vector<cv::Point2f>& standing, const NeighbourGrid& grid, cv::Point2d from, cv::Point2d to,
                  const RoofBridge& bridge) {
    const cv::Point2d way = to - from;
    const double length = std::hypot(way.x, way.y);
    if (length <= 2 * kVehicleEnd) return false;
    const cv::Point2d along = way / length;
    const cv::Point2d middle = (from + to) / 2;
    bool between = false;
    int around = 0;
    grid.around(middle, [&](std::size_t i) {
        const cv::Point2d place = standing[i];
        const double ahead = (place - from).dot(along);
        const double aside = std::abs((place - from).cross(along));
        if (ahead > kVehicleEnd && ahead < length - kVehicleEnd && aside < bridge.half_width) between = true;
        if (std::hypot(place.x - middle.x, place.y - middle.y) <= bridge.length) ++around;
    });
    const double density = around / (CV_PI * bridge.length * bridge.length);
    const double expected = density * (length - 2 * kVehicleEnd) * 2 * bridge.half_width;
    return !between && expected >= kExpected;
}

}  // namespace

std::vector<int> joinAcrossRoofs(const FrameMotion& motion, const Linkage& linkage, const RoofBridge& bridge,
                                 std::vector<int> numbers) {
    const std::vector<MotionVector>& vectors = motion.motion_vectors;
    Linkage across_roof = linkage;
    across_roof.along = bridge.length;
    across_roof.velocity_floor *= kMoreAlike;
    across_roof.velocity_share *= kMoreAlike;
    const std::vector<cv::Point2f> positions = positionsOf(vectors);
    const double reach = across_roof.reachAmong(vectors);
    const NeighbourGrid grid(positions, reach);
    const double most = std::max(1.0, reach / std::max(bridge.length, across_roof.across));
    const NeighbourGrid standing(motion.stationary_corners, bridge.length * most);

    UnionFind sets(vectors.size());
    std::vector<int> first(vectors.size(), -1);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        int& leader = first[static_cast<std::size_t>(numbers[i])];
        if (leader < 0) leader = static_cast<int>(i);
        sets.join(static_cast<int>(i), leader);
    }
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        if (!std::isfinite(positions[i].x)) continue;
        grid.around(positions[i], [&](std::size_t j) {
            const int a = static_cast<int>(i);
            const int b = static_cast<int>(j);
            if (b <= a || sets.root(a) == sets.root(b) || !across_roof.joins(vectors[i], vectors[j])) return;
            const double factor = linkage.slope.factorAt((cv::Point2d(positions[i]) + cv::Point2d(positions[j])) / 2);
            const RoofBridge here{bridge.length * factor, std::max(bridge.half_width * factor, kThinnestStrip)};
            if (roadIsHidden(motion.stationary_corners, standing, positions[i], positions[j], here)) sets.join(a, b);
        });
    }
    return sets.numbers();
}

}  // namespace eyrie
