#include "motion/clusters/motion_clustering.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/values/corner_density.h"
#include "motion/clusters/linkage_gaps.h"
#include "motion/differences/roof_bridge.h"

namespace eyrie {
namespace {

constexpr int kSplitSteps = 4;          ///< how often the linkage of a large cluster is tightened
constexpr double kTighter = 0.75;       ///< by this factor each time
constexpr double kHeldByPieces = 0.75;  ///< share of a cluster's vectors that its pieces must hold
constexpr double kSplitMargin = 2;      ///< px: corners lie up to a pixel beside the edges they belong to
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

/// Mean place of motion vectors.
cv::Point2d middleOf(const FrameMotion& motion, const std::vector<int>& members) {
    cv::Point2d sum(0, 0);
    for (const int member : members)
        sum += cv::Point2d(motion.motion_vectors[static_cast<std::size_t>(member)].position);
    return sum / std::max(1.0, static_cast<double>(members.size()));
}

/// The half axis of the ellipse that a gap uses up most.
const char* nearestLimit(const LinkageGap& gap, const Linkage& linkage) {
    return gap.aside / linkage.across > gap.ahead / linkage.along ? "clustering.across" : "clustering.along";
}

}  // namespace

MotionClustering::MotionClustering(const MotionClusteringOptions& options, const SceneScale& scale)
    : options_(options), scale_(scale) {}

Linkage MotionClustering::linkageFor(double background_speed_sigma) const {
    Linkage linkage;
    linkage.slope = scale_.slope;
    linkage.reach(scale_.px(options_.along_m), scale_.px(options_.across_m), std::max(options_.min_distance, 1e-3));
    linkage.smallest_far = options_.min_distance_far;
    const double noise =
        std::min(options_.velocity_noise_factor * background_speed_sigma, options_.velocity_noise_limit);
    linkage.velocity_floor = std::max(options_.velocity_floor, noise);
    linkage.velocity_share = options_.velocity_share;
    return linkage;
}

int MotionClustering::minMembersFor(const FrameMotion& motion, cv::Point2d place) const {
    if (options_.min_density_share <= 0) return options_.min_members;
    const double expected = cornersOnCar(motion, scale_.at(place));
    const double wanted =
        std::min(std::round(options_.min_density_share * expected), static_cast<double>(options_.max_min_members));
    return std::max(options_.min_members, static_cast<int>(wanted));
}

std::vector<MotionClustering::Piece> MotionClustering::split(const FrameMotion& motion, Piece group, Linkage linkage,
                                                             std::size_t min_members, int steps_left,
                                                             ClusteringTrace* trace) const {
    const std::vector<int>& whole = group.members;
    const MotionCluster cluster = summarise(motion, whole, options_.margin);
    const SceneScale here = scale_.at(cluster.box.centre);
    const double widest = here.px(options_.split_width_m) + kSplitMargin;
    const double longest = here.px(options_.split_length_m) + kSplitMargin;
    const bool too_wide = options_.split_width_m > 0 && cluster.box.width > widest;
    const bool too_long = options_.split_length_m > 0 && cluster.box.length > longest;
    std::vector<Piece> result;
    if ((!too_wide && !too_long) || steps_left == 0 || whole.size() < 2 * min_members) {
        result.push_back(std::move(group));
        return result;
    }
    if (too_wide) linkage.across *= kTighter;
    if (too_long) linkage.along *= kTighter;
    linkage.velocity_floor *= kTighter;
    linkage.velocity_share *= kTighter;
    std::vector<MotionVector> vectors;
    vectors.reserve(whole.size());
    for (const int member : whole) vectors.push_back(motion.motion_vectors[static_cast<std::size_t>(member)]);
    const char* const split_by = too_wide ? "clustering.split_width" : "clustering.split_length";
    const std::vector<int> numbers = singleLinkage(vectors, linkage);
    std::vector<Piece> pieces(static_cast<std::size_t>(*std::max_element(numbers.begin(), numbers.end())) + 1);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        Piece& piece = pieces[static_cast<std::size_t>(numbers[i])];
        piece.members.push_back(whole[i]);
        piece.split_by = split_by;
    }
    const auto left_over = std::stable_partition(
        pieces.begin(), pieces.end(), [&](const Piece& piece) { return piece.members.size() >= min_members; });
    const auto count = left_over - pieces.begin();
    std::size_t held = 0;
    for (auto piece = pieces.begin(); piece != left_over; ++piece) held += piece->members.size();
    const bool falls_apart =
        count >= 2 && static_cast<double>(held) >= kHeldByPieces * static_cast<double>(whole.size());
    if (!falls_apart) return split(motion, std::move(group), linkage, min_members, steps_left - 1, trace);
    for (auto piece = left_over; trace != nullptr && piece != pieces.end(); ++piece) {
        const double size = too_wide ? cluster.box.width : cluster.box.length;
        trace->groups.push_back({std::move(piece->members), -1, ClusterRefusal::split_off, size,
                                 too_wide ? widest : longest, split_by, split_by});
    }
    for (auto piece = pieces.begin(); piece != left_over; ++piece) {
        for (Piece& part : split(motion, std::move(*piece), linkage, min_members, steps_left - 1, trace))
            result.push_back(std::move(part));
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

TracedGroup MotionClustering::checkSize(const MotionCluster& cluster) const {
    TracedGroup checked;
    const SceneScale here = scale_.at(cluster.box.centre);
    const double max_length = here.px(options_.max_length_m);
    const double max_width = here.px(options_.max_width_m);
    if (!std::isfinite(cluster.box.length + cluster.box.heading)) {
        checked.refusal = ClusterRefusal::not_finite;
    } else if (max_length > 0 && cluster.box.length > max_length) {
        checked = {{}, -1, ClusterRefusal::too_long, cluster.box.length, max_length, "clustering.max_length", {}};
    } else if (max_width > 0 && cluster.box.width > max_width) {
        checked = {{}, -1, ClusterRefusal::too_wide, cluster.box.width, max_width, "clustering.max_width", {}};
    }
    return checked;
}

std::vector<MotionCluster> MotionClustering::cluster(const FrameMotion& motion, ClusteringTrace* trace) const {
    const std::vector<int> numbers = linked(motion);
    const int count = numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end()) + 1;
    std::vector<std::vector<int>> members(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        members[static_cast<std::size_t>(numbers[i])].push_back(static_cast<int>(i));
    }
    const auto parameterOf = [&](int needed) {
        return needed > options_.min_members ? "clustering.min_density_share" : "clustering.min_members";
    };
    const int needed_at_centre = minMembersFor(motion);
    if (trace != nullptr) *trace = {{}, needed_at_centre, parameterOf(needed_at_centre)};
    const Linkage linkage = linkageFor(motion.background_speed_sigma);
    std::vector<MotionCluster> clusters;
    for (std::vector<int>& group : members) {
        const cv::Point2d place = middleOf(motion, group);
        const int needed = scale_.slope.isFlat() ? needed_at_centre : minMembersFor(motion, place);
        const auto min_members = static_cast<std::size_t>(needed);
        const char* const needed_parameter = parameterOf(needed);
        if (group.size() < min_members) {
            const auto size = static_cast<double>(group.size());
            if (trace != nullptr)
                trace->groups.push_back({std::move(group),
                                         -1,
                                         ClusterRefusal::too_few,
                                         size,
                                         static_cast<double>(needed),
                                         needed_parameter,
                                         {}});
            continue;
        }
        TracedGroup checked = checkSize(summarise(motion, group, options_.margin));
        if (checked.refusal != ClusterRefusal::none) {
            checked.members = std::move(group);
            if (trace != nullptr) trace->groups.push_back(std::move(checked));
            continue;
        }
        for (Piece& piece : split(motion, {std::move(group)}, linkage.at(place), min_members, kSplitSteps, trace)) {
            if (trace != nullptr) {
                const auto size = static_cast<double>(piece.members.size());
                trace->groups.push_back({piece.members, static_cast<int>(clusters.size()), ClusterRefusal::none, size,
                                         static_cast<double>(needed), needed_parameter, piece.split_by});
            }
            clusters.push_back(summarise(motion, std::move(piece.members), options_.margin));
        }
    }
    return clusters;
}

LinkageGap MotionClustering::gapOutside(const FrameMotion& motion, const std::vector<int>& group) const {
    const Linkage everywhere = linkageFor(motion.background_speed_sigma);
    const cv::Point2d place = middleOf(motion, group);
    const Linkage linkage = everywhere.at(place);
    LinkageGap gap = smallestGapOutside(motion.motion_vectors, group, everywhere);
    const double distance = gap.aside / linkage.across > gap.ahead / linkage.along ? linkage.across : linkage.along;
    if (gap.distance <= 1)
        gap.parameter = gap.allowed > linkage.velocity_floor || linkage.velocity_share <= 0
                            ? "clustering.velocity_share"
                            : "clustering.velocity_floor";
    else if (distance <= everywhere.smallestAt(place))
        gap.parameter = distance <= options_.min_distance ? "clustering.min_distance" : "clustering.min_distance_far";
    else
        gap.parameter = nearestLimit(gap, linkage);
    return gap;
}

LinkageGap MotionClustering::gapInside(const FrameMotion& motion, const std::vector<int>& group) const {
    const Linkage everywhere = linkageFor(motion.background_speed_sigma);
    const Linkage linkage = everywhere.at(middleOf(motion, group));
    LinkageGap gap = largestGapInside(motion.motion_vectors, group, everywhere);
    gap.parameter = gap.distance > 1 ? "clustering.roof_length" : nearestLimit(gap, linkage);
    return gap;
}

ClusteringVerdict MotionClustering::verdictOn(const std::vector<int>& here, const FrameMotion& motion,
                                              const ClusteringTrace& trace) const {
    ClusteringVerdict verdict;
    verdict.here = static_cast<int>(here.size());
    verdict.needed = trace.needed;
    const auto counted = [](const TracedGroup& group) { return group.refusal != ClusterRefusal::too_few; };
    const TracedGroup* farthest = nullptr;
    for (const TracedGroup& group : trace.groups) {
        const bool is_here = std::any_of(here.begin(), here.end(), [&](int vector) {
            return std::binary_search(group.members.begin(), group.members.end(), vector);
        });
        if (!is_here) continue;
        if (group.cluster >= 0) return verdict;
        if (farthest == nullptr ||
            std::pair(counted(group), group.members.size()) > std::pair(counted(*farthest), farthest->members.size()))
            farthest = &group;
    }
    if (farthest == nullptr) return verdict;
    verdict.refusal = farthest->refusal;
    verdict.group = farthest->members;
    verdict.value = farthest->value;
    verdict.limit = farthest->limit;
    verdict.parameter = farthest->parameter;
    verdict.needed = minMembersFor(motion, middleOf(motion, farthest->members));
    // Neighbours that would have made it enough point to the linkage.
    if (verdict.refusal == ClusterRefusal::too_few && verdict.here >= verdict.needed) {
        verdict.refusal = ClusterRefusal::not_linked;
        verdict.gap = gapOutside(motion, verdict.group);
        verdict.parameter = verdict.gap.parameter;
    }
    return verdict;
}

}  // namespace eyrie
