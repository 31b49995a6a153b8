#pragma once

#include "detection/detector.h"

namespace eyrie {

/// The baseline (Teutsch §4.2): the box of the motion cluster itself is the one detection of its ROI.
class MotionClusterDetector : public Detector {
 public:
    /// `margin_px`: the box is grown by this on every side of the outermost vectors.
    explicit MotionClusterDetector(double margin_px) : margin_px_(margin_px) {}

    std::vector<Detection> detect(const MotionRoi& roi, DetectionTrace* trace = nullptr) const override;
    const VehicleModel* model() const override { return nullptr; }

 private:
    double margin_px_;
};

/// The box around the cluster's own vectors, grown by a margin, as a detection; none where the ROI has no vectors.
std::vector<Detection> clusterDetection(const MotionRoi& roi, double margin_px);
/// Boxes of a search area, in its own pixels, as detections that move as its cluster does.
std::vector<Detection> detectionsIn(const MotionRoi& roi, const std::vector<cv::Rect2d>& boxes);

}  // namespace eyrie
