#pragma once

#include "core/parameter.h"
#include "detection/segmenters/mask_segmenter.h"

namespace eyrie {

/// Parameters of segmentation by relative connectivity (Teutsch §5.4.2; optima of §7.3.2).
struct RelativeConnectivityOptions {
    double deviations = 0.6;   ///< a of T_rc = μ + a·σ
    int min_points = 3;        ///< T_m
    double low = 8;            ///< T_l
    double high_factor = 2.0;  ///< b of T_u = b·T_l
    double car_length = 24;    ///< px to which cars are scaled before; 0: the image as it is

    /// The text to the letter: T_l for vehicles of about 10×20 px, whatever their true size.
    static RelativeConnectivityOptions thesis();

    void describe(ParameterVisitor& visitor);
};

/// Object segmentation using relative connectivity (fig. 5.19): pairs of opposing edges of bright and of dark areas.
class RelativeConnectivitySegmenter : public MaskSegmenter {
 public:
    RelativeConnectivitySegmenter(const RelativeConnectivityOptions& options, const GradientOptions& components,
                                  const SceneScale& scale, double cluster_margin);

 protected:
    /// Trace layers: accumulator and binary image of bright and of dark areas, fused.
    cv::Mat objectPixels(const MotionRoi& roi, DetectionTrace* trace) const override;

 private:
    RelativeConnectivityOptions options_;
    double enlargement_;
};

}  // namespace eyrie
