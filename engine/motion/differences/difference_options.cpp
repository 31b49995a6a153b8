#include "motion/differences/difference_options.h"

#include <string>

namespace eyrie {

const char* nameOf(MotionMethod method) {
    switch (method) {
        case MotionMethod::vectors:
            return "vectors";
        case MotionMethod::two_frame_difference:
            return "two_frame_difference";
        case MotionMethod::three_frame_difference:
            return "three_frame_difference";
        case MotionMethod::median_background:
            return "median_background";
        case MotionMethod::difference_ghosts:
            return "difference_ghosts";
    }
    return "";
}

const std::vector<MotionMethod>& allMotionMethods() {
    static const std::vector<MotionMethod> all{MotionMethod::vectors, MotionMethod::two_frame_difference,
                                               MotionMethod::three_frame_difference, MotionMethod::median_background,
                                               MotionMethod::difference_ghosts};
    return all;
}

DifferenceOptions DifferenceOptions::thesis() {
    DifferenceOptions options;
    options.gap = 3;
    return options;
}

void DifferenceOptions::describe(ParameterVisitor& visitor) {
    std::vector<std::string> methods;
    for (const MotionMethod known : allMotionMethods()) methods.emplace_back(nameOf(known));
    visitor.choice("motion.method", method, methods,
                   {"",
                    "Where motion clusters come from: clustering of motion vectors, or areas of a difference image. "
                    "Motion vectors are always measured: they give such areas their velocity, and outlier removal and "
                    "tracking use them.",
                    "Teutsch §2.2, §4.2"});
    visitor.integer("difference.gap", gap, 1, 100,
                    {"frames", "Time between the images of a difference. Larger: slower vehicles, more parallax.",
                     "Teutsch §4.2, fig. 4.2"});
    visitor.integer("difference.background_frames", background_frames, 3, 100,
                    {"frames", "Number of frames whose median is the background.", "Teutsch §2.2, eq. 2.3"});
    visitor.integer("difference.background_step", background_step, 1, 100,
                    {"frames", "Time between these frames. Larger: slower vehicles leave the background.", ""});
    visitor.real("difference.gradient_suppression", gradient_suppression, 0, 10,
                 {"", "This many times the background's gradient is taken off its difference, against misregistration.",
                  "Teutsch §2.2"});
    visitor.real("difference.blur", blur_px, 0, 20,
                 {"px", "Images are smoothed by a Gaussian of this deviation first.", "Teutsch §2.2"});
    visitor.real("difference.noise_factor", noise_factor, 0, 100,
                 {"",
                  "Pixels move where the difference exceeds this many deviations of the frame's own differences. "
                  "Larger: fewer false areas, weak vehicles are lost.",
                  ""});
    visitor.real("difference.min_contrast", min_contrast, 0, 255,
                 {"grey", "Pixels move where the difference exceeds this, too.", ""});
    visitor.real(
        "difference.strong_limit", strong_limit, 1, 100,
        {"", "An area reaches Otsu's threshold somewhere, but no more than this many times the lowest difference.",
         "Teutsch §2.2"});
    visitor.real("difference.opening", opening_m, 0, 10, {"m", "Diameter of the opening; 0: none.", "Teutsch §2.2"});
    visitor.real("difference.closing", closing_m, 0, 20,
                 {"m", "Diameter of the closing, which joins front, rear and sides; 0: none.", "Teutsch §2.2"});
    visitor.real("difference.min_area", min_area_m2, 0, 1000, {"m²", "Smaller areas are dropped.", ""});
    visitor.integer("difference.min_area_px", min_area_px, 1, 100000,
                    {"px²", "Areas of fewer pixels are dropped, whatever the scale.", ""});
    visitor.real("difference.max_length", max_length_m, 0.1, 10000, {"m", "Longer areas are dropped.", ""});
    visitor.real("difference.ghost_deviation", ghost_deviation, 0, 255,
                 {"grey", "Ghosts, which show bare ground, deviate less than this inside.", "Teutsch §2.2"});
    visitor.real("difference.ghost_gradient", ghost_gradient, 0, 255,
                 {"grey/px", "Ghosts have a smaller mean gradient than this, too.", "Teutsch §2.2"});
}

}  // namespace eyrie
