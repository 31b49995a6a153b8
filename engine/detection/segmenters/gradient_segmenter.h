#pragma once

#include "core/values/scene_scale.h"
#include "detection/detector.h"
#include "detection/segmenters/component_boxes.h"
#include "detection/segmenters/gradient_options.h"
#include "imaging/lbp_gradient.h"

namespace eyrie {

/// Gradient based object segmentation (Teutsch §5.4.1, fig. 5.10): gradient magnitude, quantile threshold, closing,
/// connected components, upright boxes in the ROI.
class GradientSegmenter : public Detector {
 public:
    /// `cluster_margin`: margin of the cluster's box where that is delivered instead.
    GradientSegmenter(const GradientOptions& options, const SceneScale& scale, double cluster_margin);

    /// Trace layers: raw, gradient, lbp mask (LBP only), quantile area, binary, closed, components.
    std::vector<Detection> detect(const MotionRoi& roi, DetectionTrace* trace = nullptr) const override;

    /// The closed gradient image and the ranks of its values: another quantile is another threshold of the same image.
    std::unique_ptr<const PreparedArea> prepare(const MotionRoi& roi) const override;
    std::vector<Detection> decide(const MotionRoi& roi, const PreparedArea* prepared) const override;
    const VehicleModel* model() const override { return nullptr; }

    /// Gradient magnitude of a CV_8UC1 image by the chosen method, CV_32FC1.
    cv::Mat gradientOf(const cv::Mat& gray) const;

 private:
    cv::Mat quantileMask(const MotionRoi& roi) const;
    std::vector<cv::Rect2d> segment(const MotionRoi& roi, DetectionTrace* trace) const;
    std::vector<Detection> detectionsOf(const MotionRoi& roi, const std::vector<cv::Rect2d>& boxes,
                                        DetectionTrace* trace = nullptr) const;

    GradientOptions options_;
    LbpGradientOptions lbp_;
    ComponentBoxes component_boxes_;
    double quantile_margin_;  ///< px
    double cluster_margin_;
};

}  // namespace eyrie
