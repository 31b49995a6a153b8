#include "motion/clusters/single_linkage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/clusters/neighbour_grid.h"
#include "motion/clusters/union_find.h"

namespace eyrie {
namespace {

bool finite(const MotionVector& v) {
    return std::isfinite(v.position.x) && std::isfinite(v.position.y) && std::isfinite(v.velocity.x) &&
           std::isfinite(v.velocity.y);
}

}  // namespace

void Linkage::reach(double along_px, double across_px, double smallest_px) {
    smallest = smallest_px;
    // Elsewhere the scale may be so much finer that what is too small at the centre is not.
    along = slope.isFlat() ? std::max(along_px, smallest) : along_px;
    across = slope.isFlat() ? std::max(across_px, smallest) : across_px;
}

Linkage Linkage::at(cv::Point2d place) const {
    Linkage here = *this;
    here.slope = {};
    if (slope.isFlat()) return here;
    const double factor = slope.factorAt(place);
    here.along = std::max(smallest, along * factor);
    here.across = std::max(smallest, across * factor);
    return here;
}

double Linkage::reachAmong(const std::vector<MotionVector>& vectors) const {
    if (slope.isFlat()) return std::max(along, across);
    double reach = std::max({smallest, std::min(along, across) * ScaleSlope::kLeast, 1e-3});
    for (const MotionVector& vector : vectors) {
        if (!finite(vector)) continue;
        const Linkage here = at(vector.position);
        reach = std::max({reach, here.along, here.across});
    }
    return reach;
}

bool Linkage::joins(const MotionVector& a, const MotionVector& b) const {
    if (!slope.isFlat()) return at((cv::Point2d(a.position) + cv::Point2d(b.position)) / 2).joins(a, b);
    const double dx = static_cast<double>(b.position.x) - a.position.x;
    const double dy = static_cast<double>(b.position.y) - a.position.y;
    const double reach = std::max(along, across);
    if (dx * dx + dy * dy > reach * reach) return false;
    const double mx = (static_cast<double>(a.velocity.x) + b.velocity.x) / 2;
    const double my = (static_cast<double>(a.velocity.y) + b.velocity.y) / 2;
    const double vx = static_cast<double>(b.velocity.x) - a.velocity.x;
    const double vy = static_cast<double>(b.velocity.y) - a.velocity.y;
    const double speed = std::sqrt(mx * mx + my * my);
    const double allowed = std::max(velocity_floor, velocity_share * speed);
    if (vx * vx + vy * vy > allowed * allowed) return false;
    if (speed <= 0) return dx * dx + dy * dy <= std::min(along, across) * std::min(along, across);
    const double ahead = (dx * mx + dy * my) / (speed * along);
    const double aside = (dy * mx - dx * my) / (speed * across);
    return ahead * ahead + aside * aside <= 1;
}

std::vector<cv::Point2f> positionsOf(const std::vector<MotionVector>& vectors) {
    constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
    std::vector<cv::Point2f> positions;
    positions.reserve(vectors.size());
    for (const MotionVector& v : vectors) positions.push_back(finite(v) ? v.position : cv::Point2f(kNowhere, kNowhere));
    return positions;
}

std::vector<int> singleLinkage(const std::vector<MotionVector>& vectors, const Linkage& linkage) {
    UnionFind sets(vectors.size());
    const NeighbourGrid grid(positionsOf(vectors), linkage.reachAmong(vectors));
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        if (!finite(vectors[i])) continue;
        grid.around(vectors[i].position, [&](std::size_t j) {
            if (j > i && linkage.joins(vectors[i], vectors[j])) sets.join(static_cast<int>(i), static_cast<int>(j));
        });
    }
    return sets.numbers();
}

}  // namespace eyrie
