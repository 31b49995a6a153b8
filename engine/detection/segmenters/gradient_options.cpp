#include "detection/segmenters/gradient_options.h"

namespace eyrie {
namespace {

/// Optima of §7.3.1, table 7.3.
double thesisQuantile(GradientMethod method) {
    switch (method) {
        case GradientMethod::lbp:
            return 0.12;
        case GradientMethod::simple:
            return 0.15;
        case GradientMethod::canny:
            return 0.14;
        case GradientMethod::morphological:
            return 0.16;
    }
    return 0.12;
}

}  // namespace

double GradientOptions::effectiveQuantile() const {
    return quantile > 0 ? quantile : thesisQuantile(method);
}

GradientOptions GradientOptions::thesis(GradientMethod method) {
    GradientOptions options;
    options.method = method;
    options.quantile = 0;  // follows the method
    options.quantile_area = QuantileArea::roi;
    options.need_support = false;
    options.handle_cut = false;
    options.join_components = false;
    options.growth_along_m = 0;
    options.growth_across_m = 0;
    options.length_correction = 0;
    options.width_correction = 0;
    options.fall_back = false;
    return options;
}

void GradientOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::detection);
    const ParameterDeclarer deciding = declare.decisionOnly();
    declare.choice("gradient.method", method, {"lbp", "simple", "canny", "morphological"},
                   {"",
                    "How the gradient is made: local binary patterns, plain differences, derivatives of a Gaussian, "
                    "or dilation minus erosion.",
                    "Teutsch §5.4.1"});
    deciding.real(
        "gradient.quantile", quantile, 0, 1,
        {"",
         "Share of the brightest gradient pixels that is kept. Larger: weaker edges count, neighbours merge. 0: the "
         "optimum of table 7.3 for the gradient in use.",
         "Teutsch §7.3.1, eq. 5.14"});
    declare.choice("gradient.quantile_area", quantile_area, {"roi", "box", "vectors"},
                   {"",
                    "Pixels that choose the threshold: the whole search area, the box around the cluster's vectors, or "
                    "discs around them.",
                    ""});
    declare.real("gradient.quantile_margin", quantile_margin_m, 0, 20,
                 {"m", "How far around the vectors that area reaches; at least 1 px.", ""});
    declare.integer("gradient.lbp_radius_min", lbp_radius_min, 1, 16,
                    {"px", "Smallest radius of the local binary patterns.", "Teutsch §5.4.1, eq. 5.13"});
    declare.integer("gradient.lbp_radius_max", lbp_radius_max, 1, 16,
                    {"px", "Largest radius of the local binary patterns. Larger: less noise, wider boxes.",
                     "Teutsch §5.4.1, eq. 5.13"});
    declare.real("gradient.lbp_threshold", lbp_threshold, 0, 255,
                 {"grey", "A neighbour must be brighter than the centre by this. Larger: less noise, fewer weak edges.",
                  "Teutsch §5.4.1, eq. 5.7"});
    declare.real("gradient.canny_variance", canny_variance, 0.1, 25,
                 {"px²", "Variance of the Gaussian of the Canny gradient.", "Teutsch §5.4.1"});
    deciding.integer("gradient.min_box_area", min_box_area, 1, 10000,
                     {"px²", "Smaller boxes are dropped.", "Teutsch §5.4.1"});
    deciding.flag("gradient.need_support", need_support,
                  {"", "Keep only components that hold motion vectors of the cluster itself.", ""});
    deciding.real("gradient.support_share", support_share, 0, 1,
                  {"", "Components kept for their motion vectors hold at least this share of the cluster's.", ""});
    deciding.flag(
        "gradient.handle_cut", handle_cut,
        {"", "Components cut by the edge of the search area (kerbs, walls) keep only their part near the vectors.",
         ""});
    deciding.real("gradient.core_margin", core_margin_m, 0, 20, {"m", "How near that is; at least 1 px.", ""});
    deciding.flag("gradient.join_components", join_components,
                  {"",
                   "Fuse components that fit into one vehicle together: roofs are plain, so front, rear and sides "
                   "respond separately.",
                   ""});
    deciding.real("gradient.vehicle_length", vehicle_length_m, 0, 100, {"m", "Largest length of a fused box.", ""});
    deciding.real("gradient.vehicle_width", vehicle_width_m, 0, 100, {"m", "Largest width of a fused box.", ""});
    deciding.real("gradient.growth_along", growth_along_m, 0, 100,
                  {"m", "A box ends at most this far ahead of and behind its motion vectors; 0: no limit.", ""});
    deciding.real("gradient.growth_across", growth_across_m, 0, 100,
                  {"m", "A box ends at most this far beside its motion vectors; 0: no limit.", ""});
    deciding.real(
        "gradient.length_correction", length_correction, 0, 4,
        {"", "Boxes get shorter by this many largest LBP radii, since patterns respond beside an edge, too.", ""});
    deciding.real("gradient.width_correction", width_correction, 0, 4,
                  {"", "Boxes get narrower by this many largest LBP radii.", ""});
    deciding.flag(
        "gradient.fall_back", fall_back,
        {"", "Deliver the box of the motion cluster where the segmentation does not explain its vectors.", ""});
    deciding.real("gradient.fall_back_share", fall_back_share, 0, 1,
                  {"", "Share of the cluster's vectors that the boxes must hold to explain it.", ""});
}

}  // namespace eyrie
