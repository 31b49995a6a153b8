#include "detection/detection_options.h"

namespace eyrie {

const char* nameOf(DetectionMethod method) {
    switch (method) {
        case DetectionMethod::clusters:
            return "clusters";
        case DetectionMethod::gradient:
            return "gradient";
        case DetectionMethod::relative_connectivity:
            return "relative_connectivity";
        case DetectionMethod::sliding_window:
            return "sliding_window";
        case DetectionMethod::window_and_gradient:
            return "window_and_gradient";
        case DetectionMethod::tophat_otsu:
            return "tophat_otsu";
        case DetectionMethod::mser:
            return "mser";
        case DetectionMethod::canny_harris:
            return "canny_harris";
    }
    return "";
}

const std::vector<DetectionMethod>& allDetectionMethods() {
    static const std::vector<DetectionMethod> all{DetectionMethod::clusters,
                                                  DetectionMethod::gradient,
                                                  DetectionMethod::relative_connectivity,
                                                  DetectionMethod::sliding_window,
                                                  DetectionMethod::window_and_gradient,
                                                  DetectionMethod::tophat_otsu,
                                                  DetectionMethod::mser,
                                                  DetectionMethod::canny_harris};
    return all;
}

bool looksThroughWindows(DetectionMethod method) {
    return method == DetectionMethod::sliding_window || method == DetectionMethod::window_and_gradient;
}

DetectionOptions DetectionOptions::thesis() {
    DetectionOptions options;
    options.method = DetectionMethod::gradient;
    options.min_roi_length_m = 0;
    options.min_roi_width_m = 0;
    options.cluster_margin_px = 0;
    options.gradient = GradientOptions::thesis();
    options.relative_connectivity = RelativeConnectivityOptions::thesis();
    options.sliding_window = SlidingWindowOptions::thesis();
    options.tophat_otsu = TophatOtsuOptions::thesis();
    options.mser = MserOptions::thesis();
    return options;
}

void DetectionOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::detection);
    const ParameterDeclarer deciding = declare.decisionOnly();
    std::vector<std::string> methods;
    for (const DetectionMethod known : allDetectionMethods()) methods.emplace_back(nameOf(known));
    declare.choice("detection.method", method, methods,
                   {"",
                    "What finds objects in a search area: the motion cluster itself (baseline), segmentation by "
                    "gradients, relative connectivity, tophat transforms, stable regions, or edges and corners, a "
                    "trained sliding window, or that one where it is sure and gradients elsewhere. What gradient.* "
                    "says about components and falling back holds for all "
                    "segmentations.",
                    "Teutsch §5.4, §7.4.1"});
    declare.real("detection.extend_along", extend_along, 1, 10,
                 {"", "Search areas are motion clusters extended by this factor along the motion, to catch split ones.",
                  "Teutsch §5.4"});
    declare.real("detection.extend_across", extend_across, 1, 10,
                 {"", "Search areas are motion clusters extended by this factor across the motion.", "Teutsch §5.4"});
    declare.real("detection.min_roi_length", min_roi_length_m, 0, 100,
                 {"m", "A search area is at least this long.", ""});
    declare.real("detection.min_roi_width", min_roi_width_m, 0, 100, {"m", "A search area is at least this wide.", ""});
    deciding.real(
        "detection.cluster_margin", cluster_margin_px, 0, 20,
        {"px", "Where a cluster itself is the detection, its box is grown by this on every side of its vectors.", ""});
    gradient.describe(visitor);
    relative_connectivity.describe(visitor);
    sliding_window.describe(visitor);
    window_and_gradient.describe(visitor);
    tophat_otsu.describe(visitor);
    mser.describe(visitor);
    canny_harris.describe(visitor);
}

}  // namespace eyrie
