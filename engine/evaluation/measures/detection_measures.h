#pragma once

#include <vector>

#include "evaluation/matching.h"

namespace eyrie {

/// Detection quality over a sequence (Teutsch §7.1.1, eq. 7.2–7.8). Ratios without a denominator are 0.
struct DetectionMeasures {
    int true_positives = 0;
    int false_positives = 0;
    int false_negatives = 0;
    int ground_truth = 0;     ///< objects that count, TP + FN
    int ignored_results = 0;  ///< results that are not counted: on ignored objects or at the border
    int frames = 0;
    double overlap_sum = 0;  ///< over the true positives

    double precision = 0;  ///< eq. 7.4
    double recall = 0;     ///< eq. 7.5
    double f_score = 0;    ///< eq. 7.6
    double n_moda = 0;     ///< eq. 7.7 with c_m(x) = c_f(x) = x
    double n_modp = 0;     ///< mean overlap of the true positives; eq. 7.8 prints "1 −", which contradicts its text
    double false_positives_per_frame = 0;
};

/// Counts and measures over the frames that were matched.
DetectionMeasures detectionMeasures(const EvaluationInput& input, const std::vector<FrameMatch>& matches);

}  // namespace eyrie
