#include "chain/chain.h"

#include <opencv2/core/utility.hpp>
#include <utility>

#include "chain/recording/classified_vehicles.h"
#include "core/stopwatch.h"
#include "detection/detector_table.h"
#include "detection/roi_cutter.h"
#include "removal/detection_probability.h"

namespace eyrie {

DuplicateRemovalOptions duplicatesFor(const ChainOptions& options) {
    DuplicateRemovalOptions duplicates = options.duplicates;
    if (duplicates.strategy == DuplicateStrategy::by_detector) {
        const bool whole = kindOf(options.detection.method).whole_vehicles;
        duplicates.strategy = whole ? DuplicateStrategy::suppress : DuplicateStrategy::fuse;
    }
    return duplicates;
}

std::vector<Detection> removed(std::vector<Detection> detections, const FrameMotion& motion,
                               const ChainOptions& options, const SceneScale& scale, RemovalTrace* trace) {
    const SceneScale here = scale.zoomed(motion.registration.zoom);
    detections = removeDuplicates(std::move(detections), motion, duplicatesFor(options), here, trace);
    detections = removeOutliers(std::move(detections), motion, options.outliers, here);
    if (looksThroughWindows(options.detection.method)) judgeDetections(detections, motion);
    return detections;
}

MotionHalf::MotionHalf(const ChainOptions& options, const SceneScale& scale, double zoom_before)
    : registrar_(options.registration, scale, zoom_before), independent_motion_(options.motion, scale) {}

FrameMotion MotionHalf::next(const Frame& frame, StageTimes& times) {
    const RegisteredFrame registered = registrar_.next(frame, &times);
    const Stopwatch watch(times, Stage::motion);
    return independent_motion_.next(registered, frame);
}

TrackHalf::TrackHalf(const ChainOptions& options, const SceneScale& scale)
    : options_(options), scale_(scale), search_(options.detection, scale), tracker_(options.tracking, scale) {
    if (options.difference.method != MotionMethod::vectors)
        difference_ = std::make_unique<DifferenceMotion>(options.difference, scale);
    classifier_ = classifierOfBoxes(search_.detector(), options, scale);
    if (classifier_) scores_.emplace(scale);
    if (options.stacking.enabled) stacker_ = std::make_unique<ImageStacker>(options.stacking, scale);
}

std::vector<StackView> TrackHalf::stackViews(const Frame& frame, StackPictures pictures) const {
    return stacker_ ? stacker_->views(frame, pictures) : std::vector<StackView>{};
}

ClusteringTrace TrackHalf::clustering(const FrameMotion& motion) const {
    ClusteringTrace trace;
    if (!difference_) clusteringIn(motion).cluster(motion, &trace);
    return trace;
}

std::vector<SearchTrace> TrackHalf::trace(const Frame& frame, const FrameMotion& motion, const MotionCluster& cluster,
                                          int index) const {
    std::vector<SearchTrace> traces;
    for (MotionRoi& roi : search_.areasOf(frame, motion, cluster, index, stackedAreas(frame, motion, cluster, index))) {
        SearchTrace traced;
        traced.roi = std::move(roi);
        traced.raw = cutMotionRoi(frame, cluster, index, motion, options_.detection, scale_);
        traced.detections = search_.detector().detect(traced.roi, &traced.trace);
        traces.push_back(std::move(traced));
    }
    return traces;
}

MotionClustering TrackHalf::clusteringIn(const FrameMotion& motion) const {
    return {options_.clustering, scale_.zoomed(motion.registration.zoom)};
}

std::vector<MotionCluster> TrackHalf::findClusters(const Frame& frame, const FrameMotion& motion) {
    if (!difference_) return clusteringIn(motion).cluster(motion);
    last_difference_ = difference_->next(frame, motion);
    return last_difference_.clusters;
}

std::vector<MotionRoi> TrackHalf::stackedAreas(const Frame& frame, const FrameMotion& motion,
                                               const MotionCluster& cluster, int index) const {
    if (!stacker_) return {};
    const OrientedBox extended =
        extendedCluster(cluster, frame.gray.size(), options_.detection, scale_.zoomed(motion.registration.zoom));
    return stacker_->replace(cluster, index, extended, motion);
}

std::vector<std::vector<MotionRoi>> TrackHalf::stackedAreas(const Frame& frame, const FrameMotion& motion,
                                                            const std::vector<MotionCluster>& clusters) const {
    std::vector<std::vector<MotionRoi>> stacked(clusters.size());
    cv::parallel_for_(cv::Range(0, static_cast<int>(clusters.size())), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            const auto at = static_cast<std::size_t>(i);
            stacked[at] = stackedAreas(frame, motion, clusters[at], i);
        }
    });
    return stacked;
}

void TrackHalf::remember(const Frame& frame, const FrameMotion& motion) {
    if (difference_) difference_->remember(frame, motion);
}

FrameResult TrackHalf::next(const Frame& frame, FrameMotion motion, StageTimes times) {
    FrameResult result;
    result.motion = std::move(motion);
    {
        const Stopwatch watch(times, Stage::clustering);
        result.clusters = findClusters(frame, result.motion);
    }
    std::vector<std::vector<MotionRoi>> stacked;
    if (stacker_) {
        const Stopwatch watch(times, Stage::stacking);
        stacker_->update(frame, result.motion, result.clusters);
        // Circular stacks cut and merge their layers only now, where they are searched. All before any is searched, so
        // that this most of their time is not booked as detection.
        stacked = stackedAreas(frame, result.motion, result.clusters);
    }
    {
        const Stopwatch watch(times, Stage::detection);
        ClusterSearch::Found found = search_.search(frame, result.motion, result.clusters, std::move(stacked));
        result.detections = std::move(found.detections);
        result.rois = std::move(found.rois);
    }
    {
        const Stopwatch watch(times, Stage::removal);
        removal_ = {};
        result.detections = removed(std::move(result.detections), result.motion, options_, scale_, &removal_);
    }
    if (classifier_) {
        const Stopwatch watch(times, Stage::detection);
        classifier_->judge(result.detections, frame, result.motion.registration.zoom);
    }
    if (stacker_) {
        const Stopwatch watch(times, Stage::stacking);
        stacker_->remember(result.motion, result.detections);
    }
    {
        const Stopwatch watch(times, Stage::tracking);
        result.tracks = tracker_.next(result.motion, result.detections, nullptr, [&] { return frame.gray; });
        if (scores_) scores_->judge(result.tracks, result.detections, result.motion);
    }
    result.stage_ms = times;
    return result;
}

FrameResult Chain::next(const Frame& frame) {
    StageTimes times{};
    FrameMotion motion = motion_half_.next(frame, times);
    return track_half_.next(frame, std::move(motion), times);
}

}  // namespace eyrie
