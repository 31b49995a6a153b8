#include "detection/cluster_search.h"

#include <opencv2/core/utility.hpp>
#include <utility>

#include "detection/detector_factory.h"
#include "detection/roi_cutter.h"

namespace eyrie {

ClusterSearch::ClusterSearch(const DetectionOptions& options, const SceneScale& scale)
    : options_(options), scale_(scale), detector_(makeDetector(options, scale)) {}

std::vector<MotionRoi> ClusterSearch::areasOf(const Frame& frame, const FrameMotion& motion,
                                              const MotionCluster& cluster, int index,
                                              std::vector<MotionRoi> stacked) const {
    if (stacked.empty()) stacked.push_back(cutMotionRoi(frame, cluster, index, motion, options_, scale_));
    return stacked;
}

ClusterSearch::Found ClusterSearch::search(const Frame& frame, const FrameMotion& motion,
                                           const std::vector<MotionCluster>& clusters,
                                           std::vector<std::vector<MotionRoi>> stacked) const {
    stacked.resize(clusters.size());
    std::vector<std::vector<Detection>> per_cluster(clusters.size());
    Found found;
    found.rois.resize(clusters.size());
    // Written by index, so that the result does not depend on the number of threads.
    cv::parallel_for_(cv::Range(0, static_cast<int>(clusters.size())), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            const auto at = static_cast<std::size_t>(i);
            for (const MotionRoi& roi : areasOf(frame, motion, clusters[at], i, std::move(stacked[at]))) {
                found.rois[at] = roi.box;
                for (Detection& detection : detector_->detect(roi)) per_cluster[at].push_back(std::move(detection));
            }
        }
    });
    for (auto& in_cluster : per_cluster) {
        for (Detection& detection : in_cluster) found.detections.push_back(std::move(detection));
    }
    return found;
}

}  // namespace eyrie
