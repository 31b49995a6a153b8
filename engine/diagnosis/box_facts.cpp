#include "diagnosis/box_facts.h"

#include <algorithm>
#include <map>

#include "motion/clusters/motion_clustering.h"

namespace eyrie {
namespace {

constexpr double kMargin = 1;     ///< px; corners lie on outlines
constexpr double kCovered = 0.5;  ///< share of the box

void keepBest(NearBox& best, std::size_t index, double overlap) {
    if (overlap > best.overlap) best = {static_cast<int>(index), overlap};
}

/// Clusters in the order of how many of their points lie in the box.
std::vector<int> clustersIn(const OrientedBox& box, const FrameResult& result) {
    std::vector<std::pair<int, int>> found;  // −points, cluster
    for (std::size_t i = 0; i < result.clusters.size(); ++i) {
        const MotionCluster& cluster = result.clusters[i];
        int points = 0;
        for (const int member : cluster.members)
            points += box.contains(result.motion.motion_vectors[static_cast<std::size_t>(member)].position, kMargin);
        for (const cv::Point2f& point : cluster.moving_points) points += box.contains(point, kMargin);
        // The points of difference images are not stored; their box is.
        if (cluster.members.empty() && cluster.moving_points.empty()) points = intersectionArea(box, cluster.box) > 0;
        if (points > 0) found.emplace_back(-points, static_cast<int>(i));
    }
    std::sort(found.begin(), found.end());
    std::vector<int> clusters;
    for (const auto& entry : found) clusters.push_back(entry.second);
    return clusters;
}

}  // namespace

void FrameFacts::judgeClustering(BoxFacts& facts, const std::vector<int>& vectors) {
    facts.by_differences = options_.difference.method != MotionMethod::vectors;
    if (facts.by_differences || vectors.empty() || !facts.clusters.empty()) return;
    const MotionClustering clustering(options_.clustering, scale_);
    if (!clustering_) clustering.cluster(result_.motion, &clustering_.emplace());
    facts.clustering = clustering.verdictOn(vectors, result_.motion, *clustering_);
}

BoxFacts FrameFacts::at(const OrientedBox& box) {
    BoxFacts facts;
    const FrameResult& result = result_;
    const FrameMotion& motion = result.motion;
    facts.registration = motion.registration.state;
    facts.failure = motion.registration.failure;
    facts.image = motion.image_size;
    if (motion.registration.state == RegistrationState::registered) {
        const Homography& step = motion.registration.current_from_previous;
        facts.flow = step.apply(box.centre) - box.centre;
    }
    std::vector<int> vectors;
    for (std::size_t i = 0; i < motion.motion_vectors.size(); ++i) {
        const MotionVector& vector = motion.motion_vectors[i];
        if (!box.contains(vector.position, kMargin)) continue;
        vectors.push_back(static_cast<int>(i));
        ++facts.motion_vectors;
        facts.velocity += cv::Point2d(vector.velocity);
    }
    if (facts.motion_vectors > 0) facts.velocity /= facts.motion_vectors;
    facts.corners = facts.motion_vectors +
                    static_cast<int>(std::count_if(motion.stationary_corners.begin(), motion.stationary_corners.end(),
                                                   [&](const cv::Point2f& p) { return box.contains(p, kMargin); }));
    facts.clusters = clustersIn(box, result);
    judgeClustering(facts, vectors);

    const auto shown = [this](const OrientedBox& one) { return upright_ ? one.upright() : one; };
    const OrientedBox place = shown(box);
    for (std::size_t i = 0; i < result.detections.size(); ++i) {
        const Detection& detection = result.detections[i];
        const OrientedBox other = shown(detection.box);
        const double shared = overlap(place, other);
        if (detection.rejection != Rejection::none) {
            keepBest(facts.rejected, i, shared);
            continue;
        }
        keepBest(facts.kept, i, shared);
        if (place.area() > 0 && intersectionArea(place, other) >= kCovered * place.area())
            facts.covering.push_back(static_cast<int>(i));
    }
    if (facts.rejected.index >= 0) {
        const Detection& rejected = result.detections[static_cast<std::size_t>(facts.rejected.index)];
        facts.rejection = rejected.rejection;
        facts.rejected_vectors = static_cast<int>(rejected.vectors.size());
    }
    for (std::size_t i = 0; i < result.dropped.size(); ++i)
        keepBest(facts.dropped, i, overlap(place, shown(result.dropped[i].box)));
    if (facts.dropped.index >= 0) facts.drop = result.dropped[static_cast<std::size_t>(facts.dropped.index)];
    for (std::size_t i = 0; i < result.tracks.size(); ++i) {
        const TrackState& track = result.tracks[i];
        const double shared = overlap(place, shown(track.box));
        keepBest(track.status == TrackStatus::tentative ? facts.tentative : facts.confirmed, i, shared);
    }
    return facts;
}

}  // namespace eyrie
