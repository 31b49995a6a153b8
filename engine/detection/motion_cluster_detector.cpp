#include "detection/motion_cluster_detector.h"

#include "detection/segmenters/component_boxes.h"
#include "imaging/upright_patch.h"

namespace eyrie {

std::vector<Detection> detectionsIn(const MotionRoi& roi, const std::vector<cv::Rect2d>& boxes) {
    std::vector<Detection> detections;
    detections.reserve(boxes.size());
    for (const cv::Rect2d& box : boxes) {
        Detection detection;
        detection.box = boxInImage(roi.image_from_roi, box);
        detection.velocity = roi.velocity;
        detection.cluster = roi.cluster;
        detections.push_back(detection);
    }
    return detections;
}

std::vector<Detection> clusterDetection(const MotionRoi& roi, double margin_px) {
    if (roi.vectors.empty()) return {};
    return detectionsIn(roi, {grown(boundsOf(roi.vectors), margin_px, margin_px)});
}

std::vector<Detection> MotionClusterDetector::detect(const MotionRoi& roi, DetectionTrace* trace) const {
    if (trace != nullptr) trace->add(TraceLayer::raw, roi.image);
    return clusterDetection(roi, margin_px_);
}

}  // namespace eyrie
