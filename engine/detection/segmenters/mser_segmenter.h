#pragma once

#include "core/parameter.h"
#include "detection/segmenters/mask_segmenter.h"

namespace eyrie {

/// Parameters of segmentation by maximally stable extremal regions (Matas et al. 2002, after Teutsch §7.4.1).
struct MserOptions {
    int delta = 5;               ///< grey values over which a region must be stable
    double max_variation = 0.5;  ///< largest relative growth over delta
    double min_area_m2 = 0.6;    ///< size limits of a region
    double max_area_m2 = 40;
    double max_eccentricity = 0.98;
    bool keep_spanning = false;  ///< regions from edge to edge of the search area are kept, too

    /// As published: only size and shape decide.
    static MserOptions thesis();
    void describe(ParameterVisitor& visitor);
};

/// Bright and dark regions that are stable over grey values, of a vehicle's size and not too long for their width.
class MserSegmenter : public MaskSegmenter {
 public:
    MserSegmenter(const MserOptions& options, const GradientOptions& components, const SceneScale& scale,
                  double cluster_margin);

 protected:
    /// Trace layers: regions (all), binary (those kept).
    cv::Mat objectPixels(const MotionRoi& roi, DetectionTrace* trace) const override;

 private:
    MserOptions options_;
    int min_area_;  ///< px²
    int max_area_;  ///< px²
};

/// Eccentricity of the ellipse with the points' second moments: 0 for a disc, towards 1 for a line.
double eccentricityOf(const std::vector<cv::Point>& points);

}  // namespace eyrie
