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
    // Of motion.method, too: it says where clusters come from, motion vectors are the same for all.
    const ParameterDeclarer declare(visitor, ChainStage::clustering);
    std::vector<std::string> methods;
    for (const MotionMethod known : allMotionMethods()) methods.emplace_back(nameOf(known));
    declare.choice("motion.method", method, methods,
                   {"",
                    "Where motion clusters come from: clustering of motion vectors, or areas of a difference image. "
                    "Motion vectors are always measured: they give such areas their velocity, and outlier removal and "
                    "tracking use them.",
                    "Teutsch §2.2, §4.2"});
    declare.integer("difference.gap", gap, 1, 100,
                    {"frames", "Time between the images of a difference. Larger: slower vehicles, more parallax.",
                     "Teutsch §4.2, fig. 4.2"});
    declare.integer("difference.background_frames", background_frames, 3, 100,
                    {"frames", "Number of frames whose median is the background.", "Teutsch §2.2, eq. 2.3"});
    declare.integer("difference.background_step", background_step, 1, 100,
                    {"frames", "Time between these frames. Larger: slower vehicles leave the background.", ""});
    declare.real("difference.gradient_suppression", gradient_suppression, 0, 10,
                 {"", "This many times the background's gradient is taken off its difference, against misregistration.",
                  "Teutsch §2.2"});
    declare.real("difference.blur", blur, 0, 20,
                 {"px", "Images are smoothed by a Gaussian of this deviation first.", "Teutsch §2.2"});
    declare.real("difference.noise_factor", noise_factor, 0, 100,
                 {"",
                  "Pixels move where the difference exceeds this many deviations of the frame's own differences. "
                  "Larger: fewer false areas, weak vehicles are lost.",
                  ""});
    declare.real("difference.min_contrast", min_contrast, 0, 255,
                 {"grey", "Pixels move where the difference exceeds this, too.", ""});
    declare.real(
        "difference.strong_limit", strong_limit, 1, 100,
        {"", "An area reaches Otsu's threshold somewhere, but no more than this many times the lowest difference.",
         "Teutsch §2.2"});
    declare.real("difference.opening", opening_m, 0, 10, {"m", "Diameter of the opening; 0: none.", "Teutsch §2.2"});
    declare.real("difference.closing", closing_m, 0, 20,
                 {"m", "Diameter of the closing, which joins front, rear and sides; 0: none.", "Teutsch §2.2"});
    declare.real("difference.min_area", min_area_m2, 0, 1000, {"m²", "Smaller areas are dropped.", ""});
    declare.integer("difference.min_area_px", min_area_px, 1, 100000,
                    {"px²", "Areas of fewer pixels are dropped, whatever the scale.", ""});
    declare.real("difference.max_length", max_length_m, 0.1, 10000, {"m", "Longer areas are dropped.", ""});
    declare.real("difference.ghost_deviation", ghost_deviation, 0, 255,
                 {"grey", "Ghosts, which show bare ground, deviate less than this inside.", "Teutsch §2.2"});
    declare.real("difference.ghost_gradient", ghost_gradient, 0, 255,
                 {"grey/px", "Ghosts have a smaller mean gradient than this, too.", "Teutsch §2.2"});
}

}  // namespace eyrie
