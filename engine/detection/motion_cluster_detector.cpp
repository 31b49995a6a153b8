#include "detection/motion_cluster_detector.h"

#include "detection/segmenters/component_boxes.h"
#include "imaging/upright_patch.h"

namespace eyrie {

std::vector<Detection> clusterDetection(const MotionRoi& roi, double margin_px) {
    if (roi.vectors.empty()) return {};
    Detection detection;
    detection.box = boxInImage(roi.image_from_roi, grown(boundsOf(roi.vectors), margin_px, margin_px));
    detection.velocity = roi.velocity;
    detection.cluster = roi.cluster;
    return {detection};
}

std::vector<Detection> MotionClusterDetector::detect(const MotionRoi& roi, DetectionTrace* trace) const {
    if (trace != nullptr) trace->add("raw", roi.image);
    return clusterDetection(roi, margin_px_);
}

}  // namespace eyrie
