#pragma once

#include "core/parameter.h"
#include "detection/segmenters/mask_segmenter.h"

namespace eyrie {

/// Parameters of segmentation by tophat transforms (Zheng et al. 2013, after Teutsch §7.4.1, fig. 7.13).
struct TophatOtsuOptions {
    double element_m = 3.0;    ///< diameter of the tophat's structuring element: wider than a vehicle
    double smoothing_m = 0.4;  ///< diameter of closing and opening before it: as wide as road markings
    double min_contrast = 8;   ///< grey values; the threshold is at least that
    double joining_m = 0.5;    ///< diameter of the closing of the binary image; 0: none

    /// As published: Otsu's threshold as it is, and nothing is joined.
    static TophatOtsuOptions thesis();
    void describe(ParameterVisitor& visitor);
};

/// White and black tophat of the smoothed image, the stronger of the two, Otsu's threshold.
class TophatOtsuSegmenter : public MaskSegmenter {
 public:
    TophatOtsuSegmenter(const TophatOtsuOptions& options, const GradientOptions& components, const SceneScale& scale,
                        double cluster_margin);

 protected:
    /// Trace layers: smoothed, white tophat, black tophat, binary, closed.
    cv::Mat objectPixels(const MotionRoi& roi, DetectionTrace* trace) const override;

 private:
    double min_contrast_;
    cv::Mat element_;
    cv::Mat smoothing_;
    cv::Mat joining_;  ///< empty: no closing
};

}  // namespace eyrie
