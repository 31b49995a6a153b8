#pragma once

#include "core/parameter.h"
#include "detection/segmenters/mask_segmenter.h"

namespace eyrie {

/// Parameters of segmentation by edges and corners (Cheng et al. 2012, after Teutsch §7.4.1; without its colours).
struct CannyHarrisOptions {
    double high = 40;  ///< grey values of a sharp step
    double low_share = 0.4;
    double corner_share = 0.02;  ///< a corner has at least this share of the strongest Harris response
    double link_m = 1.5;         ///< corners this close form a cluster; edges this close belong to it
    int min_corners = 3;         ///< of a cluster
    double closing_m = 0.7;      ///< diameter of the closing

    void describe(ParameterVisitor& visitor);
};

/// Canny edges near clusters of Harris corners, closed.
class CannyHarrisSegmenter : public MaskSegmenter {
 public:
    CannyHarrisSegmenter(const CannyHarrisOptions& options, const GradientOptions& components, const SceneScale& scale,
                         double cluster_margin);

 protected:
    /// Trace layers: edges, corners, clustered, closed.
    cv::Mat objectPixels(const MotionRoi& roi, DetectionTrace* trace) const override;

 private:
    cv::Mat cornersOf(const MotionRoi& roi) const;
    cv::Mat nearClusters(const cv::Mat& corners) const;

    CannyHarrisOptions options_;
    double link_px_;
    cv::Mat closing_;
};

}  // namespace eyrie
