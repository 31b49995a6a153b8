#pragma once

#include <vector>

#include "core/parameter.h"

namespace eyrie {

/// Where motion clusters come from (Teutsch §2.2, §4.2).
enum class MotionMethod {
    vectors,                 ///< clustering of motion vectors, the thesis' way
    two_frame_difference,    ///< difference to a frame some time ago (eq. 2.1)
    three_frame_difference,  ///< the smaller one of two differences (eq. 2.2), which avoids most ghosts
    median_background,       ///< difference to the median of many frames (eq. 2.3)
    difference_ghosts        ///< two frames, with explicit rejection of ghosts (Saleemi and Shah 2013)
};
/// The word used in parameters and tables.
const char* nameOf(MotionMethod method);
/// All of them, `vectors` first.
const std::vector<MotionMethod>& allMotionMethods();

/// Parameters of motion clusters from difference images.
struct DifferenceOptions {
    MotionMethod method = MotionMethod::vectors;
    int gap = 6;                        ///< frames between the images of a difference (n)
    int background_frames = 12;         ///< N of the median background
    int background_step = 4;            ///< frames between them
    double gradient_suppression = 0.5;  ///< share of the background's gradient taken off the difference; 0: none
    double blur = 1.0;                  ///< px, deviation of the Gaussian before differences are taken
    double noise_factor = 5;            ///< pixels move from this many deviations of the frame's own difference on
    double min_contrast = 6;            ///< … and from this difference on, grey values
    double strong_limit = 2.5;          ///< Otsu's threshold is not followed beyond this many times that
    double opening_m = 0.3;             ///< diameters of the morphology
    double closing_m = 1.5;
    double min_area_m2 = 1.0;    ///< smaller areas are dropped
    int min_area_px = 12;        ///< … whatever the scale
    double max_length_m = 40;    ///< longer ones, too
    double ghost_deviation = 6;  ///< ghosts have less grey value deviation inside …
    double ghost_gradient = 6;   ///< … and less mean gradient, grey values per px

    /// The gap of fig. 4.2 d.
    static DifferenceOptions thesis();
    /// Groups "motion" (the method) and "difference".
    void describe(ParameterVisitor& visitor);
};

}  // namespace eyrie
