#include "motion/clusters/linkage_gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eyrie {
namespace {

constexpr double kUnlike = 1e6;  ///< linkage distances added where velocities differ: the last link to be taken

const MotionVector& vectorAt(const std::vector<MotionVector>& vectors, int index) {
    return vectors[static_cast<std::size_t>(index)];
}

}  // namespace

LinkageGap gapBetween(const MotionVector& a, const MotionVector& b, const Linkage& everywhere) {
    const Linkage linkage = everywhere.at((cv::Point2d(a.position) + cv::Point2d(b.position)) / 2);
    const cv::Point2d apart = cv::Point2d(b.position) - cv::Point2d(a.position);
    const cv::Point2d mean = (cv::Point2d(a.velocity) + cv::Point2d(b.velocity)) / 2;
    const cv::Point2d change = cv::Point2d(b.velocity) - cv::Point2d(a.velocity);
    const double speed = std::hypot(mean.x, mean.y);
    LinkageGap gap;
    gap.ahead = speed > 0 ? std::abs(apart.dot(mean)) / speed : std::hypot(apart.x, apart.y);
    gap.aside = speed > 0 ? std::abs(mean.cross(apart)) / speed : 0;
    gap.difference = std::hypot(change.x, change.y);
    gap.allowed = std::max(linkage.velocity_floor, linkage.velocity_share * speed);
    gap.distance = std::hypot(gap.ahead / linkage.along, gap.aside / linkage.across);
    gap.joined = linkage.joins(a, b);
    return gap;
}

LinkageGap smallestGapOutside(const std::vector<MotionVector>& vectors, const std::vector<int>& group,
                              const Linkage& linkage) {
    std::vector<char> inside(vectors.size(), 0);
    for (const int member : group) inside[static_cast<std::size_t>(member)] = 1;
    LinkageGap best;
    double best_cost = std::numeric_limits<double>::max();
    for (const int member : group) {
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            if (inside[i]) continue;
            const LinkageGap gap = gapBetween(vectorAt(vectors, member), vectors[i], linkage);
            const double cost = std::max(gap.distance, gap.difference / std::max(gap.allowed, 1e-9));
            if (!(cost < best_cost)) continue;
            best_cost = cost;
            best = gap;
            best.other = static_cast<int>(i);
        }
    }
    return best;
}

LinkageGap largestGapInside(const std::vector<MotionVector>& vectors, const std::vector<int>& group,
                            const Linkage& linkage) {
    // Prim's algorithm over linkage distances.
    LinkageGap largest;
    if (group.size() < 2) return largest;
    std::vector<LinkageGap> reach(group.size());
    for (LinkageGap& gap : reach) gap.distance = std::numeric_limits<double>::max();
    std::vector<char> inside(group.size(), 0);
    std::size_t newest = 0;
    inside[0] = 1;
    for (std::size_t step = 1; step < group.size(); ++step) {
        std::size_t next = group.size();
        for (std::size_t i = 0; i < group.size(); ++i) {
            if (inside[i]) continue;
            LinkageGap gap = gapBetween(vectorAt(vectors, group[newest]), vectorAt(vectors, group[i]), linkage);
            gap.other = group[i];
            if (gap.difference > gap.allowed) gap.distance += kUnlike;
            if (gap.distance < reach[i].distance) reach[i] = gap;
            if (next == group.size() || reach[i].distance < reach[next].distance) next = i;
        }
        inside[next] = 1;
        newest = next;
        if (reach[next].distance < kUnlike && (largest.other < 0 || reach[next].distance > largest.distance))
            largest = reach[next];
    }
    return largest;
}

}  // namespace eyrie
