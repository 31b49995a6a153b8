#pragma once

#include <string>
#include <vector>

#include "core/parameter.h"

namespace eyrie {

/// How a search area is rescaled before it is scanned (Teutsch §7.3.3, table 7.5).
enum class WindowRescaling {
    joint_11,   ///< case 1: 11 scales, width and length together
    length_11,  ///< case 2: 11 scales of the length
    length_3    ///< case 3, the thesis' choice: 3 scales of the length
};

/// Parameters of the local sliding window (Teutsch §5.4.3; optima of §7.3.3).
struct SlidingWindowOptions {
    static constexpr double kNoRejection = 1000;  ///< as rejection_margin: every window is looked at to the end

    std::string model;       ///< path of a model file; empty: the one that is shipped
    std::string descriptor;  ///< that the model must have been trained for; empty: any
    WindowRescaling rescaling = WindowRescaling::length_3;
    double car_length_m = 4.6;  ///< of a vehicle that fills the window as a median training sample does, at scale 1
    double car_width_m = 2.0;
    double smallest_scale = 0.85;  ///< of the scales, which are spread geometrically between the two
    double middle_scale = 0;       ///< one of the scales is exactly this; 0: none is bound
    double largest_scale = 1.5;
    double decision_threshold = 0;   ///< T_d; 0 is the classifier's own border
    double overlap_threshold = 0.1;  ///< T_dov of the second non-maximum suppression
    double rejection_margin = 4;     ///< of the early rejection; see WindowScanner
    double context_m = 0.8;          ///< search areas are this much wider and longer on every side
    bool need_support = true;        ///< only windows whose box holds vectors of the cluster
    double support_share = 0.1;      ///< … at least this share of them
    bool fall_back = false;          ///< deliver the cluster's box where no window is accepted

    /// The scale factors of the rescaling in use, ascending.
    std::vector<double> scales() const;
    /// The text to the letter: the original size and lengths from small cars to lorries of 17 m, no early rejection, no
    /// support, no other detection.
    static SlidingWindowOptions thesis();
    void describe(ParameterVisitor& visitor);
};

}  // namespace eyrie
