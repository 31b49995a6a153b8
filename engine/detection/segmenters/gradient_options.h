#pragma once

#include "core/parameter.h"

namespace eyrie {

/// How the gradient magnitude is made (Teutsch §5.4.1, table 7.3).
enum class GradientMethod { lbp, simple, canny, morphological };

/// The pixels whose gradients choose the threshold.
enum class QuantileArea {
    roi,     ///< the whole extended cluster, as in the thesis
    box,     ///< the box around the cluster's own vectors, grown by `quantile_margin_m`
    vectors  ///< discs of `quantile_margin_m` around the cluster's own vectors
};

/// Parameters of gradient based object segmentation (Teutsch §5.4.1).
struct GradientOptions {
    GradientMethod method = GradientMethod::lbp;
    double quantile = 0.35;  ///< share of the brightest gradient pixels that is kept; 0: the optimum of table 7.3
    QuantileArea quantile_area = QuantileArea::vectors;
    double quantile_margin_m = 0.5;
    int lbp_radius_min = 1;          ///< px
    int lbp_radius_max = 2;          ///< px
    double lbp_threshold = 3;        ///< grey values
    double canny_variance = 0.5;     ///< px²
    int min_box_area = 10;           ///< px²
    bool need_support = true;        ///< only components that hold vectors of the cluster
    double support_share = 0.1;      ///< … at least this share of them
    bool handle_cut = true;          ///< components cut by the ROI's edge keep only the part near the vectors
    double core_margin_m = 0.3;      ///< what counts as near
    bool join_components = true;     ///< fuse components that fit into one vehicle
    double vehicle_length_m = 6.0;   ///< largest fused length
    double vehicle_width_m = 2.8;    ///< largest fused width
    double growth_along_m = 2.0;     ///< a box ends at most this far ahead and behind its vectors; 0: no limit
    double growth_across_m = 0.4;    ///< … and beside them; 0: no limit
    double length_correction = 0.5;  ///< boxes get shorter by this many largest LBP radii …
    double width_correction = 0.5;   ///< … and narrower by this many
    bool fall_back = true;           ///< deliver the cluster's box where segmentation does not explain its vectors
    double fall_back_share = 0.6;    ///< share of the cluster's vectors that the boxes must hold

    /// The quantile in use: where none is chosen, the one that table 7.3 found best for the method.
    double effectiveQuantile() const;
    /// The text to the letter, with the quantile it found best for whatever method.
    static GradientOptions thesis(GradientMethod method = GradientMethod::lbp);
    void describe(ParameterVisitor& visitor);
};

}  // namespace eyrie
