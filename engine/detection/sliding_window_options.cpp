#include "detection/sliding_window_options.h"

#include <algorithm>
#include <cmath>

namespace eyrie {

std::vector<double> SlidingWindowOptions::scales() const {
    const int count = rescaling == WindowRescaling::length_3 ? 3 : 11;
    const double smallest = std::min(smallest_scale, largest_scale);
    const double largest = std::max(smallest_scale, largest_scale);
    std::vector<double> factors;
    for (int i = 0; i < count; ++i) factors.push_back(smallest * std::pow(largest / smallest, i / (count - 1.0)));
    return factors;
}

SlidingWindowOptions SlidingWindowOptions::thesis() {
    SlidingWindowOptions options;
    options.need_support = false;
    options.fall_back = false;
    return options;
}

void SlidingWindowOptions::describe(ParameterVisitor& visitor) {
    visitor.words(
        "sliding_window.model", model,
        {"", "Path of the model file that decides; empty: the model that comes with Eyrie.", "Teutsch §5.4.3"});
    visitor.words("sliding_window.descriptor", descriptor,
                  {"",
                   "Descriptor that the model must have been trained for, so that no other is used by mistake; empty: "
                   "any.",
                   ""});
    visitor.choice(
        "sliding_window.rescaling", rescaling, {"joint_11", "length_11", "length_3"},
        {"", "Scales that are searched: 11 of width and length together, 11 of the length, or 3 of the length.",
         "Teutsch §7.3.3, table 7.5"});
    visitor.real("sliding_window.car_length", car_length_m, 0.1, 100,
                 {"m", "Length of a median car: what the window shows at scale 1.", "Teutsch §5.4.3"});
    visitor.real("sliding_window.car_width", car_width_m, 0.1, 100,
                 {"m", "Width of a median car; boxes get this width.", "Teutsch §5.4.3"});
    visitor.real("sliding_window.smallest_scale", smallest_scale, 0.1, 10,
                 {"", "Shortest vehicle, in lengths of the median car.", "Teutsch §7.3.3"});
    visitor.real("sliding_window.largest_scale", largest_scale, 0.1, 10,
                 {"", "Longest vehicle, in lengths of the median car.", "Teutsch §7.3.3"});
    visitor.real("sliding_window.decision_threshold", decision_threshold, -1000, 1000,
                 {"",
                  "Windows with a smaller decision value are dropped (T_d); 0 is the classifier's own border. Larger: "
                  "fewer false alarms, more misses.",
                  "Teutsch §7.3.3, fig. 7.8"});
    visitor.real("sliding_window.overlap_threshold", overlap_threshold, 0, 1,
                 {"", "Of windows that overlap more than this, the surest stays (T_dov).", "Teutsch §7.3.3"});
    visitor.real("sliding_window.rejection_margin", rejection_margin, 0, 1000,
                 {"",
                  "How far below the weakest training vehicle a window may lie before it is given up early. Smaller: "
                  "faster, and unusual vehicles may be lost.",
                  ""});
    visitor.real("sliding_window.context", context_m, 0, 20,
                 {"m", "Search areas are wider and longer by this on every side, as windows show surroundings.", ""});
    visitor.flag("sliding_window.need_support", need_support,
                 {"", "Keep only windows whose box holds motion vectors of the cluster itself.", ""});
    visitor.real("sliding_window.support_share", support_share, 0, 1,
                 {"", "… at least this share of the cluster's vectors.", ""});
    visitor.flag("sliding_window.fall_back", fall_back,
                 {"", "Deliver the box of the motion cluster where no window is accepted.", ""});
}

}  // namespace eyrie
