#include "detection/detection_options.h"

#include "detection/detector_table.h"

namespace eyrie {

const char* nameOf(DetectionMethod method) {
    return kindOf(method).name;
}

bool looksThroughWindows(DetectionMethod method) {
    return kindOf(method).through_windows;
}

DetectionOptions DetectionOptions::thesis() {
    DetectionOptions options;
    options.method = DetectionMethod::gradient;
    options.min_roi_length_m = 0;
    options.min_roi_width_m = 0;
    options.min_roi_length_px = 0;
    options.min_roi_width_px = 0;
    options.cluster_margin = 0;
    for (const DetectionMethod known : allDetectionMethods()) kindOf(known).set_as_in_thesis(options);
    return options;
}

void DetectionOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::detection);
    const ParameterDeclarer deciding = declare.decisionOnly();
    std::vector<std::string> methods;
    for (const DetectionMethod known : allDetectionMethods()) methods.emplace_back(nameOf(known));
    declare.choosesModel().choice(
        "detection.method", method, methods,
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
    declare.real("detection.min_roi_length_px", min_roi_length_px, 0, 1000,
                 {"px",
                  "A search area is at least this long, however coarse the picture: where a small vehicle lies is not "
                  "known to the pixel.",
                  ""});
    declare.real("detection.min_roi_width_px", min_roi_width_px, 0, 1000,
                 {"px", "A search area is at least this wide, however coarse the picture.", ""});
    deciding.real(
        "detection.cluster_margin", cluster_margin, 0, 20,
        {"px", "Where a cluster itself is the detection, its box is grown by this on every side of its vectors.", ""});
    for (const DetectionMethod known : allDetectionMethods()) kindOf(known).describe(*this, visitor);
}

}  // namespace eyrie
