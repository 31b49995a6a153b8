#include "motion/clusters/single_linkage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

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

double Linkage::smallestAt(cv::Point2d place) const {
    return smallestWhere(slope.factorAt(place));
}

Linkage Linkage::at(cv::Point2d place) const {
    Linkage here = *this;
    here.slope = {};
    std::tie(here.along, here.across) = halfAxesAt(place);
    return here;
}

std::pair<double, double> Linkage::halfAxesAt(cv::Point2d place) const {
    if (slope.isFlat()) return {along, across};
    const double factor = slope.factorAt(place);
    const double least = smallestWhere(factor);
    return {std::max(least, along * factor), std::max(least, across * factor)};
}

double Linkage::reachAmong(const std::vector<MotionVector>& vectors) const {
    if (slope.isFlat()) return std::max(along, across);
    double reach = std::max({smallest, std::min(along, across) * ScaleSlope::kLeast, 1e-3});
    for (const MotionVector& vector : vectors) {
        if (!finite(vector)) continue;
        const auto [here_along, here_across] = halfAxesAt(vector.position);
        reach = std::max({reach, here_along, here_across});
    }
    return reach;
}

// Asked of all pairs near each other, so what is cheap comes first and the scale, which varies, last.
bool Linkage::joins(const MotionVector& a, const MotionVector& b) const {
    const double mx = (static_cast<double>(a.velocity.x) + b.velocity.x) / 2;
    const double my = (static_cast<double>(a.velocity.y) + b.velocity.y) / 2;
    const double vx = static_cast<double>(b.velocity.x) - a.velocity.x;
    const double vy = static_cast<double>(b.velocity.y) - a.velocity.y;
    const double speed_squared = mx * mx + my * my;
    const double change_squared = vx * vx + vy * vy;
    if (change_squared > velocity_floor * velocity_floor &&
        change_squared > velocity_share * velocity_share * speed_squared)
        return false;
    const auto [ahead_px, aside_px] = halfAxesAt((cv::Point2d(a.position) + cv::Point2d(b.position)) / 2);
    const double dx = static_cast<double>(b.position.x) - a.position.x;
    const double dy = static_cast<double>(b.position.y) - a.position.y;
    const double distance_squared = dx * dx + dy * dy;
    const double farthest = std::max(ahead_px, aside_px);
    if (distance_squared > farthest * farthest) return false;
    const double nearest = std::min(ahead_px, aside_px);
    if (speed_squared <= 0) return distance_squared <= nearest * nearest;
    const double ahead = (dx * mx + dy * my) / ahead_px;
    const double aside = (dy * mx - dx * my) / aside_px;
    return ahead * ahead + aside * aside <= speed_squared;
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
