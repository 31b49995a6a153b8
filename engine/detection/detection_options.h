#pragma once

#include "core/parameter.h"
#include "detection/segmenters/canny_harris_segmenter.h"
#include "detection/segmenters/gradient_options.h"
#include "detection/segmenters/mser_segmenter.h"
#include "detection/segmenters/relative_connectivity_segmenter.h"
#include "detection/segmenters/tophat_otsu_segmenter.h"
#include "detection/sliding_window/sliding_window_options.h"
#include "detection/sliding_window/window_and_gradient_detector.h"

namespace eyrie {

/// The detector in use (Teutsch §5.4, §7.4.1).
enum class DetectionMethod {
    clusters,               ///< the baseline: the motion clusters themselves
    gradient,               ///< gradient based segmentation (§5.4.1)
    relative_connectivity,  ///< pairs of opposing edges (§5.4.2)
    sliding_window,         ///< a trained classifier (§5.4.3)
    window_and_gradient,    ///< the sliding window where it is sure, gradients elsewhere
    tophat_otsu,            ///< after Zheng et al. 2013
    mser,                   ///< after Matas et al. 2002
    canny_harris            ///< after Cheng et al. 2012
};
/// The word used in parameters and tables, e.g. "relative_connectivity".
const char* nameOf(DetectionMethod method);
/// Whether a trained classifier takes part.
bool looksThroughWindows(DetectionMethod method);
/// All of them, in the order of tables 7.6 and 7.7.
const std::vector<DetectionMethod>& allDetectionMethods();

/// Parameters of detection in motion ROIs.
struct DetectionOptions {
    DetectionMethod method = DetectionMethod::window_and_gradient;
    double extend_along = 2.0;       ///< a cluster is extended by this factor along its motion
    double extend_across = 1.25;     ///< … and by this one across it
    double min_roi_length_m = 7;     ///< a search area is at least this long …
    double min_roi_width_m = 3.2;    ///< … and wide
    double min_roi_length_px = 28;   ///< … and so many px, since where a small vehicle lies is not known to the pixel
    double min_roi_width_px = 12.5;  ///< … and wide
    double cluster_margin = 0.5;     ///< px by which the box of a cluster is grown on every side of its vectors
    GradientOptions gradient;        ///< what it says about components holds for every segmentation
    RelativeConnectivityOptions relative_connectivity;
    SlidingWindowOptions sliding_window;
    WindowAndGradientOptions window_and_gradient;
    TophatOtsuOptions tophat_otsu;
    MserOptions mser;
    CannyHarrisOptions canny_harris;

    /// The text to the letter, with the optima of §7.3.
    static DetectionOptions thesis();
    void describe(ParameterVisitor& visitor);
};

}  // namespace eyrie
