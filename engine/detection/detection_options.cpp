#include "detection/detection_options.h"

namespace eyrie {

DetectionOptions DetectionOptions::thesis() {
    DetectionOptions options;
    options.method = DetectionMethod::gradient;
    options.min_roi_length_m = 0;
    options.min_roi_width_m = 0;
    options.cluster_margin_px = 0;
    options.gradient = GradientOptions::thesis();
    return options;
}

void DetectionOptions::describe(ParameterVisitor& visitor) {
    visitor.choice("detection.method", method, {"clusters", "gradient"},
                   {"",
                    "What finds objects in a search area: the motion cluster itself (baseline), or gradient based "
                    "segmentation.",
                    "Teutsch §5.4"});
    visitor.real("detection.extend_along", extend_along, 1, 10,
                 {"", "Search areas are motion clusters extended by this factor along the motion, to catch split ones.",
                  "Teutsch §5.4"});
    visitor.real("detection.extend_across", extend_across, 1, 10,
                 {"", "… and by this factor across the motion.", "Teutsch §5.4"});
    visitor.real("detection.min_roi_length", min_roi_length_m, 0, 100,
                 {"m", "A search area is at least this long.", ""});
    visitor.real("detection.min_roi_width", min_roi_width_m, 0, 100, {"m", "A search area is at least this wide.", ""});
    visitor.real(
        "detection.cluster_margin", cluster_margin_px, 0, 20,
        {"px", "Where a cluster itself is the detection, its box is grown by this on every side of its vectors.", ""});
    gradient.describe(visitor);
}

}  // namespace eyrie
