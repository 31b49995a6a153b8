#pragma once

#include "core/parameter.h"
#include "detection/mask_segmenter.h"

namespace eyrie {

/// Parameters of segmentation by relative connectivity (Teutsch §5.4.2; optima of §7.3.2).
struct RelativeConnectivityOptions {
    double deviations = 1.2;         ///< a of T_rc = μ + a·σ
    int min_points = 3;              ///< T_m
    double low = 40;                 ///< T_l, at the thesis' 0.345 m/px
    double high_factor = 2.0;        ///< b of T_u = b·T_l
    bool follow_scale = false;       ///< T_l grows with the size of vehicles in pixels
    double reference_gsd_m = 0.345;  ///< m/px at which `low` holds

    void describe(ParameterVisitor& visitor);
};

/// Object segmentation using relative connectivity (fig. 5.19): pairs of opposing edges of bright and of dark areas.
class RelativeConnectivitySegmenter : public MaskSegmenter {
 public:
    RelativeConnectivitySegmenter(const RelativeConnectivityOptions& options, const GradientOptions& components,
                                  const SceneScale& scale, double cluster_margin_px);

 protected:
    /// Trace layers: accumulator and binary image of bright and of dark areas, fused.
    cv::Mat objectPixels(const MotionRoi& roi, DetectionTrace* trace) const override;

 private:
    RelativeConnectivityOptions options_;
    double low_;
};

}  // namespace eyrie
