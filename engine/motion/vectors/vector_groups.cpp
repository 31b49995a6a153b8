#include "motion/vectors/vector_groups.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

constexpr double kAlong = 3.5;           ///< m
constexpr double kAcross = 1.0;          ///< m
constexpr double kVelocityFloor = 0.03;  ///< px/frame
constexpr double kNoiseLimit = 0.06;     ///< px/frame; noise beyond this is not trusted

}  // namespace

Linkage vehicleLinkage(const SceneScale& scale, double background_speed_sigma, double velocity_share) {
    Linkage linkage;
    linkage.slope = scale.slope;
    linkage.reach(scale.px(kAlong), scale.px(kAcross), kSmallestLinkage);
    linkage.velocity_floor = std::max(kVelocityFloor, std::min(background_speed_sigma, kNoiseLimit));
    linkage.velocity_share = velocity_share;
    return linkage;
}

std::vector<VectorGroup> groupVectors(const std::vector<MotionVector>& vectors, const std::vector<int>& chosen,
                                      const Linkage& linkage) {
    std::vector<MotionVector> part;
    part.reserve(chosen.size());
    for (const int index : chosen) part.push_back(vectors[static_cast<std::size_t>(index)]);
    const std::vector<int> numbers = singleLinkage(part, linkage);
    std::vector<VectorGroup> groups;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto number = static_cast<std::size_t>(numbers[i]);
        if (number >= groups.size()) groups.resize(number + 1);
        groups[number].members.push_back(chosen[i]);
    }
    for (VectorGroup& group : groups) {
        std::vector<cv::Point2d> positions;
        for (const int member : group.members) {
            const MotionVector& vector = vectors[static_cast<std::size_t>(member)];
            group.velocity += cv::Point2d(vector.velocity);
            positions.push_back(vector.position);
        }
        group.velocity /= static_cast<double>(group.members.size());
        group.box = boxAround(positions, std::atan2(group.velocity.y, group.velocity.x));
    }
    return groups;
}

}  // namespace eyrie
