#include "chain/chain.h"

#include <opencv2/core/utility.hpp>
#include <utility>

#include "chain/stopwatch.h"
#include "detection/detector_factory.h"
#include "detection/roi_cutter.h"

namespace eyrie {

MotionHalf::MotionHalf(const ChainOptions& options, const SceneScale& scale)
    : registrar_(options.registration, scale), independent_motion_(options.motion, scale) {}

FrameMotion MotionHalf::next(const Frame& frame, StageTimes& times) {
    const RegisteredFrame registered = registrar_.next(frame, &times);
    const Stopwatch watch(times, Stage::motion);
    return independent_motion_.next(registered, frame);
}

TrackHalf::TrackHalf(const ChainOptions& options, const SceneScale& scale)
    : options_(options),
      scale_(scale),
      clustering_(options.clustering, scale),
      detector_(makeDetector(options.detection, scale)),
      tracker_(options.tracking, scale) {}

std::vector<Detection> TrackHalf::detect(const Frame& frame, const FrameMotion& motion,
                                         const std::vector<MotionCluster>& clusters,
                                         std::vector<OrientedBox>& rois) const {
    std::vector<std::vector<Detection>> per_cluster(clusters.size());
    rois.resize(clusters.size());
    // Written by index, so that the result does not depend on the number of threads.
    cv::parallel_for_(cv::Range(0, static_cast<int>(clusters.size())), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            const auto at = static_cast<std::size_t>(i);
            const MotionRoi roi = cutMotionRoi(frame, clusters[at], i, motion, options_.detection, scale_);
            rois[at] = roi.box;
            per_cluster[at] = detector_->detect(roi);
        }
    });
    std::vector<Detection> all;
    for (auto& found : per_cluster) {
        for (auto& detection : found) all.push_back(std::move(detection));
    }
    return all;
}

FrameResult TrackHalf::next(const Frame& frame, FrameMotion motion, StageTimes times) {
    FrameResult result;
    result.motion = std::move(motion);
    {
        const Stopwatch watch(times, Stage::clustering);
        result.clusters = clustering_.cluster(result.motion);
    }
    {
        const Stopwatch watch(times, Stage::detection);
        result.detections = detect(frame, result.motion, result.clusters, result.rois);
    }
    {
        const Stopwatch watch(times, Stage::removal);
        result.detections = removeDuplicates(std::move(result.detections), result.motion, options_.duplicates, scale_);
        result.detections = removeOutliers(std::move(result.detections), result.motion, options_.outliers, scale_);
    }
    {
        const Stopwatch watch(times, Stage::tracking);
        result.tracks = tracker_.next(result.motion, result.detections);
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
