#include "diagnosis/box_facts.h"

#include <algorithm>

#include "motion/clusters/motion_clustering.h"
#include "motion/clusters/place_contents.h"
#include "removal/outlier_removal.h"

namespace eyrie {
namespace {

constexpr double kCovered = 0.5;  ///< share of the box

void keepBest(NearBox& best, std::size_t index, double overlap) {
    if (overlap > best.overlap) best = {static_cast<int>(index), overlap};
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
    facts.scale = scale_.at(box.centre);
    facts.image = motion.image_size;
    if (motion.registration.state == RegistrationState::registered) {
        const Homography& step = motion.registration.current_from_previous;
        facts.flow = step.apply(box.centre) - box.centre;
    }
    const std::vector<int> vectors = vectorsAtPlace(box, motion);
    facts.motion_vectors = static_cast<int>(vectors.size());
    for (const int index : vectors)
        facts.velocity += cv::Point2d(motion.motion_vectors[static_cast<std::size_t>(index)].velocity);
    if (facts.motion_vectors > 0) facts.velocity /= facts.motion_vectors;
    facts.corners =
        facts.motion_vectors +
        static_cast<int>(std::count_if(motion.stationary_corners.begin(), motion.stationary_corners.end(),
                                       [&](const cv::Point2f& p) { return box.contains(p, kOutlineMargin_px); }));
    facts.clusters = clustersAtPlace(box, motion, result.clusters);
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
        facts.removal = whyRemoved(rejected, motion, options_.outliers, scale_);
    }
    for (std::size_t i = 0; i < result.dropped.size(); ++i)
        keepBest(facts.dropped, i, overlap(place, shown(result.dropped[i].box)));
    if (facts.dropped.index >= 0) facts.drop = result.dropped[static_cast<std::size_t>(facts.dropped.index)];
    for (std::size_t i = 0; i < result.tracks.size(); ++i) {
        const TrackState& track = result.tracks[i];
        const double shared = overlap(place, shown(track.box));
        keepBest(track.status == TrackStatus::tentative ? facts.tentative : facts.confirmed, i, shared);
    }
    if (facts.tentative.index >= 0) {
        const TrackState& track = result.tracks[static_cast<std::size_t>(facts.tentative.index)];
        facts.unconfirmed = {track.id, track.box, TrackDrop::unconfirmed, 0};
    }
    return facts;
}

}  // namespace eyrie
