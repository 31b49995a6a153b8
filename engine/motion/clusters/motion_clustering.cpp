#include "motion/clusters/motion_clustering.h"

#include <algorithm>
#include <cmath>

#include "motion/differences/roof_bridge.h"

namespace eyrie {
namespace {

constexpr int kSplitSteps = 4;          ///< how often the linkage of a large cluster is tightened
constexpr double kTighter = 0.75;       ///< by this factor each time
constexpr double kHeldByPieces = 0.75;  ///< share of a cluster's vectors that its pieces must hold
constexpr double kSplitMargin = 2;      ///< px: corners lie up to a pixel beside the edges they belong to
constexpr double kCarArea = 4.5 * 1.8;  ///< m², what a car covers seen from above
constexpr double kRoofHalfWidth = 0.6;  ///< m, of the strip that must be free of standing corners

MotionCluster summarise(const FrameMotion& motion, std::vector<int> members, double margin) {
    MotionCluster cluster;
    std::vector<cv::Point2f> positions;
    positions.reserve(members.size());
    for (const int member : members) {
        const MotionVector& vector = motion.motion_vectors[static_cast<std::size_t>(member)];
        cluster.velocity += cv::Point2d(vector.velocity);
        positions.push_back(vector.position);
    }
    cluster.velocity /= static_cast<double>(members.size());
    cluster.box = boxAround(positions, std::atan2(cluster.velocity.y, cluster.velocity.x));
    cluster.box.length += 2 * margin;
    cluster.box.width += 2 * margin;
    cluster.members = std::move(members);
    return cluster;
}

}  // namespace

MotionClustering::MotionClustering(const MotionClusteringOptions& options, const SceneScale& scale)
    : options_(options), scale_(scale) {}

Linkage MotionClustering::linkageFor(double background_speed_sigma) const {
    Linkage linkage;
    linkage.along = std::max({scale_.px(options_.along_m), options_.min_distance_px, 1e-3});
    linkage.across = std::max({scale_.px(options_.across_m), options_.min_distance_px, 1e-3});
    const double noise =
        std::min(options_.velocity_noise_factor * background_speed_sigma, options_.velocity_noise_limit_px);
    linkage.velocity_floor = std::max(options_.velocity_floor_px, noise);
    linkage.velocity_share = options_.velocity_share;
    return linkage;
}

int MotionClustering::minMembersFor(const FrameMotion& motion) const {
    const double image_area = static_cast<double>(motion.image_size.area());
    if (image_area <= 0 || options_.min_density_share <= 0) return options_.min_members;
    const double car_area = kCarArea / (scale_.gsd_m_per_px * scale_.gsd_m_per_px);
    const double expected = motion.corner_count / image_area * car_area;
    const double wanted =
        std::min(std::round(options_.min_density_share * expected), static_cast<double>(options_.max_min_members));
    return std::max(options_.min_members, static_cast<int>(wanted));
}

std::vector<std::vector<int>> MotionClustering::split(const FrameMotion& motion, std::vector<int> group,
                                                      Linkage linkage, std::size_t min_members, int steps_left) const {
    const MotionCluster whole = summarise(motion, group, options_.margin_px);
    const bool too_wide =
        options_.split_width_m > 0 && whole.box.width > scale_.px(options_.split_width_m) + kSplitMargin;
    const bool too_long =
        options_.split_length_m > 0 && whole.box.length > scale_.px(options_.split_length_m) + kSplitMargin;
    if ((!too_wide && !too_long) || steps_left == 0 || group.size() < 2 * min_members) return {std::move(group)};
    if (too_wide) linkage.across *= kTighter;
    if (too_long) linkage.along *= kTighter;
    linkage.velocity_floor *= kTighter;
    linkage.velocity_share *= kTighter;
    std::vector<MotionVector> vectors;
    vectors.reserve(group.size());
    for (const int member : group) vectors.push_back(motion.motion_vectors[static_cast<std::size_t>(member)]);
    const std::vector<int> numbers = singleLinkage(vectors, linkage);
    std::vector<std::vector<int>> pieces(static_cast<std::size_t>(*std::max_element(numbers.begin(), numbers.end())) +
                                         1);
    for (std::size_t i = 0; i < numbers.size(); ++i) pieces[static_cast<std::size_t>(numbers[i])].push_back(group[i]);
    std::erase_if(pieces, [&](const std::vector<int>& piece) { return piece.size() < min_members; });
    std::size_t held = 0;
    for (const auto& piece : pieces) held += piece.size();
    const bool falls_apart =
        pieces.size() >= 2 && static_cast<double>(held) >= kHeldByPieces * static_cast<double>(group.size());
    if (!falls_apart) return split(motion, std::move(group), linkage, min_members, steps_left - 1);
    std::vector<std::vector<int>> result;
    for (auto& piece : pieces) {
        for (auto& part : split(motion, std::move(piece), linkage, min_members, steps_left - 1)) {
            result.push_back(std::move(part));
        }
    }
    return result;
}

std::vector<int> MotionClustering::linked(const FrameMotion& motion) const {
    const Linkage linkage = linkageFor(motion.background_speed_sigma);
    std::vector<int> numbers = singleLinkage(motion.motion_vectors, linkage);
    const double roof = scale_.px(options_.roof_length_m);
    if (roof <= linkage.along) return numbers;
    return joinAcrossRoofs(motion, linkage, {roof, std::max(scale_.px(kRoofHalfWidth), 1.0)}, std::move(numbers));
}

std::vector<MotionCluster> MotionClustering::cluster(const FrameMotion& motion) const {
    const std::vector<int> numbers = linked(motion);
    const int count = numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end()) + 1;
    std::vector<std::vector<int>> members(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        members[static_cast<std::size_t>(numbers[i])].push_back(static_cast<int>(i));
    }
    const auto min_members = static_cast<std::size_t>(minMembersFor(motion));
    const double max_length = scale_.px(options_.max_length_m);
    const double max_width = scale_.px(options_.max_width_m);
    const auto fits = [&](const MotionCluster& cluster) {
        return std::isfinite(cluster.box.length + cluster.box.heading) &&
               !(max_length > 0 && cluster.box.length > max_length) &&
               !(max_width > 0 && cluster.box.width > max_width);
    };
    const Linkage linkage = linkageFor(motion.background_speed_sigma);
    std::vector<MotionCluster> clusters;
    for (std::vector<int>& group : members) {
        if (group.size() < min_members) continue;
        if (!fits(summarise(motion, group, options_.margin_px))) continue;
        for (auto& piece : split(motion, std::move(group), linkage, min_members, kSplitSteps)) {
            clusters.push_back(summarise(motion, std::move(piece), options_.margin_px));
        }
    }
    return clusters;
}

}  // namespace eyrie
