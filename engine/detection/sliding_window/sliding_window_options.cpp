#include "detection/sliding_window/sliding_window_options.h"

#include <algorithm>
#include <cmath>

#include "detection/sliding_window/model_location.h"

namespace eyrie {

std::vector<double> SlidingWindowOptions::scales() const {
    const int last = rescaling == WindowRescaling::length_3 ? 2 : 10;
    const double smallest = std::min(smallest_scale, largest_scale);
    const double largest = std::max(smallest_scale, largest_scale);
    std::vector<double> factors;
    const auto spread = [&](double from, double to, int steps) {
        for (int i = 0; i < steps; ++i) factors.push_back(from * std::pow(to / from, static_cast<double>(i) / steps));
    };
    if (middle_scale > smallest && middle_scale < largest) {
        // The nearest of the even spread moves there, the others are spread evenly on both sides of it.
        const double place = last * std::log(middle_scale / smallest) / std::log(largest / smallest);
        const int below = std::clamp(static_cast<int>(std::lround(place)), 1, last - 1);
        spread(smallest, middle_scale, below);
        spread(middle_scale, largest, last - below);
    } else {
        spread(smallest, largest, last);
    }
    factors.push_back(largest);
    return factors;
}

SlidingWindowOptions SlidingWindowOptions::thesis() {
    SlidingWindowOptions options;
    options.model = kThesisModelWord;
    options.decision_threshold = 30;  // the optimum of that model on `seq1`, found as §7.3.3 says
    // Beside the original, cars of 4 to 5 m, an image for smaller cars and one for buses and lorries of 15 to 20 m.
    options.smallest_scale = 0.85;
    options.middle_scale = 1;
    options.largest_scale = 3.8;
    options.rejection_margin = kNoRejection;
    options.context_m = 0;  // what is scanned is the extended cluster itself
    options.need_support = false;
    options.fall_back = false;
    return options;
}

void SlidingWindowOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::detection);
    const ParameterDeclarer deciding = declare.decisionOnly();
    const ParameterDeclarer choosing = declare.choosesModel();
    choosing.words(
        "sliding_window.model", model,
        {"",
         "Path of the model file that decides; empty: the model that comes with Eyrie; thesis: the one trained "
         "as the thesis says.",
         "Teutsch §5.4.3"});
    choosing.words(
        "sliding_window.descriptor", descriptor,
        {"",
         "Descriptor that the model must have been trained for, so that no other is used by mistake: moments, "
         "dct, hog, chnftrs (channel features) or multi_lbp; empty: any.",
         ""});
    declare.choice(
        "sliding_window.rescaling", rescaling, {"joint_11", "length_11", "length_3"},
        {"", "Scales that are searched: 11 of width and length together, 11 of the length, or 3 of the length.",
         "Teutsch §7.3.3, table 7.5"});
    declare.real("sliding_window.car_length", car_length_m, 0.1, 100,
                 {"m", "Length of a median car: what the window shows at scale 1.", "Teutsch §5.4.3"});
    declare.real("sliding_window.car_width", car_width_m, 0.1, 100,
                 {"m", "Width of a median car; boxes get this width.", "Teutsch §5.4.3"});
    declare.real("sliding_window.smallest_scale", smallest_scale, 0.1, 10,
                 {"", "Shortest vehicle, in lengths of the median car.", "Teutsch §7.3.3"});
    declare.real("sliding_window.middle_scale", middle_scale, 0, 10,
                 {"", "One of the scales is exactly this, if it lies between the two others; 0: all are spread evenly.",
                  "Teutsch §5.4.3"});
    declare.real("sliding_window.largest_scale", largest_scale, 0.1, 10,
                 {"", "Longest vehicle, in lengths of the median car.", "Teutsch §7.3.3"});
    deciding.real("sliding_window.decision_threshold", decision_threshold, -1000, 1000,
                  {"",
                   "Windows with a smaller decision value are dropped (T_d); 0 is the classifier's own border. Larger: "
                   "fewer false alarms, more misses. Values are the model's own: another one needs another threshold.",
                   "Teutsch §7.3.3, fig. 7.8"});
    deciding.real("sliding_window.overlap_threshold", overlap_threshold, 0, 1,
                  {"", "Of windows that overlap more than this, the surest stays (T_dov).", "Teutsch §7.3.3"});
    declare.real("sliding_window.rejection_margin", rejection_margin, 0, kNoRejection,
                 {"",
                  "How far below the weakest training vehicle a window may lie before it is given up early. Smaller: "
                  "faster, and unusual vehicles may be lost. 1000: none is given up.",
                  ""});
    declare.real("sliding_window.context", context_m, 0, 20,
                 {"m", "Search areas are wider and longer by this on every side, as windows show surroundings.", ""});
    deciding.flag("sliding_window.need_support", need_support,
                  {"", "Keep only windows whose box holds motion vectors of the cluster itself.", ""});
    deciding.real("sliding_window.support_share", support_share, 0, 1,
                  {"", "Windows kept for their motion vectors hold at least this share of the cluster's.", ""});
    deciding.flag("sliding_window.fall_back", fall_back,
                  {"", "Deliver the box of the motion cluster where no window is accepted.", ""});
}

}  // namespace eyrie
