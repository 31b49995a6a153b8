#pragma once

#include "core/parameter.h"
#include "detection/gradient_options.h"

namespace eyrie {

/// The detector in use (Teutsch §5.4). `clusters` is the baseline: the motion clusters themselves.
enum class DetectionMethod { clusters, gradient };

/// Parameters of detection in motion ROIs.
struct DetectionOptions {
    DetectionMethod method = DetectionMethod::gradient;
    double extend_along = 2.0;       ///< a cluster is extended by this factor along its motion
    double extend_across = 1.25;     ///< … and by this one across it
    double min_roi_length_m = 7;     ///< a search area is at least this long …
    double min_roi_width_m = 3.2;    ///< … and wide
    double cluster_margin_px = 0.5;  ///< the box of a cluster is grown by this on every side of its vectors
    GradientOptions gradient;

    /// The text to the letter, with the optima of §7.3.
    static DetectionOptions thesis();
    void describe(ParameterVisitor& visitor);
};

}  // namespace eyrie
