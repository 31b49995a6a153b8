#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "explain/explanation_steps.h"

namespace eyrie::explaining {
namespace {

/// How two motion vectors stand to each other, as linkage sees them (eq. of Linkage::joins).
struct Gap {
    int other = -1;
    double ahead = 0;                                      ///< px along their mean motion
    double aside = 0;                                      ///< px across it
    double difference = 0;                                 ///< px/frame between the velocities
    double allowed = 0;                                    ///< px/frame
    double distance = std::numeric_limits<double>::max();  ///< in linkage distances
    bool too_far = false;
    bool too_different = false;
};

Gap gapBetween(const MotionVector& a, const MotionVector& b, const Linkage& linkage) {
    const cv::Point2d apart = cv::Point2d(b.position) - cv::Point2d(a.position);
    const cv::Point2d mean = (cv::Point2d(a.velocity) + cv::Point2d(b.velocity)) / 2;
    const cv::Point2d change = cv::Point2d(b.velocity) - cv::Point2d(a.velocity);
    const double speed = std::hypot(mean.x, mean.y);
    Gap gap;
    gap.ahead = speed > 0 ? std::abs(apart.dot(mean)) / speed : std::hypot(apart.x, apart.y);
    gap.aside = speed > 0 ? std::abs(mean.cross(apart)) / speed : 0;
    gap.difference = std::hypot(change.x, change.y);
    gap.allowed = std::max(linkage.velocity_floor, linkage.velocity_share * speed);
    gap.distance = std::hypot(gap.ahead / linkage.along, gap.aside / linkage.across);
    gap.too_far = gap.distance > 1;
    gap.too_different = gap.difference > gap.allowed;
    return gap;
}

std::string parameterOf(const Gap& gap, const Linkage& linkage, const Story& story) {
    if (!gap.too_far) {
        const double share = linkage.velocity_share;
        return gap.allowed > linkage.velocity_floor || share <= 0 ? "clustering.velocity_share"
                                                                  : "clustering.velocity_floor";
    }
    const bool across = gap.aside / linkage.across > gap.ahead / linkage.along;
    const double limit = across ? linkage.across : linkage.along;
    if (limit <= story.options.clustering.min_distance_px) return "clustering.min_distance";
    return across ? "clustering.across" : "clustering.along";
}

std::string gapText(const Gap& gap, const Linkage& linkage, const Story& story) {
    return numberText(gap.ahead) + " px ahead and " + numberText(gap.aside) + " px aside (linkage " +
           numberText(linkage.along) + " × " + numberText(linkage.across) + " px), velocities differ by " +
           story.speedText(gap.difference) + " (allowed " + numberText(gap.allowed) + ")";
}

/// The smallest gap from a group of vectors to one outside that does not join.
Gap nextOutside(const FrameMotion& motion, const std::set<int>& group, const Linkage& linkage) {
    Gap best;
    double best_cost = std::numeric_limits<double>::max();
    for (const int member : group) {
        const MotionVector& a = motion.motion_vectors[static_cast<std::size_t>(member)];
        for (std::size_t i = 0; i < motion.motion_vectors.size(); ++i) {
            if (group.count(static_cast<int>(i)) > 0) continue;
            Gap gap = gapBetween(a, motion.motion_vectors[i], linkage);
            const double cost = std::max(gap.distance, gap.difference / std::max(gap.allowed, 1e-9));
            if (cost >= best_cost) continue;
            best_cost = cost;
            best = gap;
            best.other = static_cast<int>(i);
        }
    }
    return best;
}

/// The largest gap inside a group along its spanning links: what held it together last.
Gap weakestLink(const FrameMotion& motion, const std::vector<int>& members, const Linkage& linkage) {
    // Prim's algorithm over linkage distances.
    Gap weakest;
    weakest.distance = -1;
    if (members.size() < 2) return weakest;
    std::vector<Gap> reach(members.size());
    std::vector<char> inside(members.size(), 0);
    std::size_t newest = 0;
    inside[0] = 1;
    for (std::size_t step = 1; step < members.size(); ++step) {
        std::size_t next = members.size();
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (inside[i]) continue;
            Gap gap = gapBetween(motion.motion_vectors[static_cast<std::size_t>(members[newest])],
                                 motion.motion_vectors[static_cast<std::size_t>(members[i])], linkage);
            if (gap.too_different) gap.distance += 1e6;
            if (gap.distance < reach[i].distance) reach[i] = gap;
            if (next == members.size() || reach[i].distance < reach[next].distance) next = i;
        }
        inside[next] = 1;
        newest = next;
        if (reach[next].distance < 1e6 && reach[next].distance > weakest.distance) weakest = reach[next];
    }
    return weakest;
}

/// Why vectors that lie here are in no cluster.
void tellNoCluster(Story& story, const std::set<int>& here, const Linkage& linkage) {
    const FrameMotion& motion = story.evidence.result.motion;
    const MotionClustering clustering(story.options.clustering, story.scale);
    const std::vector<int> numbers = clustering.linked(motion);
    std::size_t largest = 0;
    std::set<int> group;
    for (const int index : here) {
        std::set<int> linked;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (numbers[i] == numbers[static_cast<std::size_t>(index)]) linked.insert(static_cast<int>(i));
        }
        if (linked.size() > largest) {
            largest = linked.size();
            group = linked;
        }
    }
    const auto needed = static_cast<std::size_t>(clustering.minMembersFor(motion));
    const bool by_density = static_cast<int>(needed) > story.options.clustering.min_members;
    const std::string count_parameter = by_density ? "clustering.min_density_share" : "clustering.min_members";
    const std::string text = countText(largest, "motion vector is", "motion vectors are") + " linked here, " +
                             std::to_string(needed) + " are needed";
    if (largest < needed) {
        story.fail("clustering", text, count_parameter);
        const Gap gap = nextOutside(motion, group, linkage);
        if (gap.other >= 0 && gap.distance < 10)
            story.note("clustering", "the next vector is " + gapText(gap, linkage, story),
                       parameterOf(gap, linkage, story));
        // Neighbours that would have made it enough point to the linkage.
        if (here.size() >= needed && here.size() > largest)
            story.decide(std::to_string(here.size()) + " motion vectors lie here, but only " + std::to_string(largest) +
                             " are linked: the next is " + gapText(gap, linkage, story),
                         parameterOf(gap, linkage, story));
        story.decide(
            countText(largest, "motion vector", "motion vectors") + ", " + std::to_string(needed) + " are needed",
            count_parameter);
        return;
    }
    story.pass("clustering", text, count_parameter);
    std::vector<cv::Point2f> positions;
    cv::Point2d velocity(0, 0);
    for (const int member : group) {
        const MotionVector& vector = motion.motion_vectors[static_cast<std::size_t>(member)];
        positions.push_back(vector.position);
        velocity += cv::Point2d(vector.velocity);
    }
    const OrientedBox box = boxAround(positions, std::atan2(velocity.y, velocity.x));
    const double longest = story.scale.px(story.options.clustering.max_length_m);
    const double widest = story.scale.px(story.options.clustering.max_width_m);
    if (story.options.clustering.max_length_m > 0 && box.length > longest) {
        story.fail("clustering", "linked vectors are " + story.lengthText(box.length) + " long",
                   "clustering.max_length");
        story.decide("The vectors linked here are " + story.lengthText(box.length) + " long, " +
                         story.lengthText(longest) + " are allowed",
                     "clustering.max_length");
        return;
    }
    if (story.options.clustering.max_width_m > 0 && box.width > widest) {
        story.fail("clustering", "linked vectors are " + story.lengthText(box.width) + " wide", "clustering.max_width");
        story.decide("The vectors linked here are " + story.lengthText(box.width) + " wide, " +
                         story.lengthText(widest) + " are allowed",
                     "clustering.max_width");
        return;
    }
    story.fail("clustering", "left over when a cluster that was too wide was split", "clustering.split_width");
    story.decide(
        "The vectors here were left over when a cluster of " + story.lengthText(box.width) + " width was split",
        "clustering.split_width");
}

}  // namespace

bool tellClusters(Story& story, std::vector<int>& clusters) {
    const FrameResult& result = story.evidence.result;
    const OrientedBox& area = story.evidence.area;
    std::set<int> here;
    for (std::size_t i = 0; i < result.motion.motion_vectors.size(); ++i) {
        if (area.contains(result.motion.motion_vectors[i].position, kCornerMargin)) here.insert(static_cast<int>(i));
    }
    for (std::size_t k = 0; k < result.clusters.size(); ++k) {
        const auto& members = result.clusters[k].members;
        const bool holds = std::any_of(members.begin(), members.end(), [&](int m) { return here.count(m) > 0; });
        const bool by_difference = members.empty() && atPlace(result.clusters[k].box, area);
        if (holds || by_difference) clusters.push_back(static_cast<int>(k));
    }
    const bool by_vectors = story.options.difference.method == MotionMethod::vectors;
    if (clusters.empty() && !by_vectors) {
        story.fail("clustering", "the difference image shows no moving area here", "motion.method");
        story.decide("The difference image shows no moving area here", "motion.method");
        return false;
    }
    const MotionClustering clustering(story.options.clustering, story.scale);
    const Linkage linkage = clustering.linkageFor(result.motion.background_speed_sigma);
    if (clusters.empty()) {
        tellNoCluster(story, here, linkage);
        return false;
    }
    for (const int k : clusters) {
        const MotionCluster& cluster = result.clusters[static_cast<std::size_t>(k)];
        story.pass("clustering",
                   "cluster " + std::to_string(k + 1) + ": " +
                       countText(cluster.members.size(), "motion vector", "motion vectors") + " (" +
                       std::to_string(clustering.minMembersFor(result.motion)) + " are needed), " +
                       story.lengthText(cluster.box.length) + " × " + story.lengthText(cluster.box.width),
                   "clustering.min_members");
        const Gap link = weakestLink(result.motion, cluster.members, linkage);
        if (link.distance > 1)
            story.note(
                "clustering",
                "front and rear of a plain roof: no standing corner in a gap of " + gapText(link, linkage, story),
                "clustering.roof_length");
        else if (link.distance >= 0)
            story.note(
                "clustering", "held together at its weakest link by " + gapText(link, linkage, story),
                link.aside / linkage.across > link.ahead / linkage.along ? "clustering.across" : "clustering.along");
        const Gap gap =
            nextOutside(result.motion, std::set<int>(cluster.members.begin(), cluster.members.end()), linkage);
        const bool split = !gap.too_far && !gap.too_different;
        if (gap.other >= 0 && gap.distance < 4)
            story.note("clustering",
                       "the nearest vector outside is " + gapText(gap, linkage, story) +
                           (split ? "; they came apart when a cluster that was too large was split" : ""),
                       split ? "clustering.split_width" : parameterOf(gap, linkage, story));
    }
    if (clusters.size() > 1)
        story.note("clustering", "the vectors here belong to " + std::to_string(clusters.size()) + " clusters",
                   "clustering.along");
    return true;
}

}  // namespace eyrie::explaining
