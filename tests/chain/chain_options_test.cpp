#include "chain/chain_options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "core/error.h"

namespace eyrie::chain_options_test {

TEST(ChainOptions, everyParameterIsNamedOnceAndExplained) {
    ChainOptions options;
    std::set<std::string> names;
    for (const auto& parameter : listParameters(describeOf(options))) {
        EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name << " is declared twice";
        EXPECT_NE(parameter.name.find('.'), std::string::npos) << parameter.name;
        EXPECT_GE(parameter.text.help.size(), 15U) << parameter.name;
    }
}

TEST(ChainOptions, defaultsAndPresetsLieInsideTheirRanges) {
    for (const auto& preset : builtInPresets()) {
        ChainOptions options = builtInPreset(preset);
        ChainOptions copy;
        for (const auto& [name, value] : parameterValues(options)) {
            EXPECT_NO_THROW(setParameter(describeOf(copy), name, value)) << preset << ": " << name;
        }
        EXPECT_EQ(parameterValues(copy), parameterValues(options)) << "saving and loading is the identity";
    }
}

TEST(ChainOptions, theThesisPresetHoldsItsOptima) {
    ChainOptions options = builtInPreset("thesis");
    std::map<std::string, std::string> values;
    for (const auto& [name, value] : parameterValues(options)) values[name] = value;
    EXPECT_EQ(values.at("gradient.quantile"), "0") << "follows the gradient";
    EXPECT_EQ(values.at("tracking.min_overlap"), "0.5");
    EXPECT_EQ(values.at("motion.min_age"), "5");
    EXPECT_THROW(builtInPreset("best"), Error);
    EXPECT_DOUBLE_EQ(options.detection.gradient.effectiveQuantile(), 0.12);
    setParameter(describeOf(options), "gradient.method", "canny");
    EXPECT_DOUBLE_EQ(options.detection.gradient.effectiveQuantile(), 0.14);
}

TEST(ChainOptions, theThesisPresetSwitchesEveryAdditionOff) {
    ChainOptions options = builtInPreset("thesis");
    for (const Parameter& parameter : listParameters(describeOf(options))) {
        if (parameter.kind != ParameterKind::flag || !parameter.text.source.empty()) continue;
        EXPECT_EQ(parameter.value, "false") << parameter.name << " is our own, so the preset must switch it off";
    }
}

/// Numbers and choices of our own are 0 in the preset, or what asks for nothing where that is another value. Those that
/// are neither change nothing of the text, and it is told here why: they only count beside something that the preset
/// switches off …
const std::vector<std::tuple<std::string, std::string, std::string>> kOfWhatIsOff{
    {"motion.slow_", "motion.find_slow", "false"},
    {"motion.shadow_", "motion.shadow_test", "false"},
    {"motion.silhouette_", "motion.silhouettes", "false"},
    {"motion.area_", "motion.areas", "false"},
    {"motion.local_background_", "motion.local_background", "false"},
    {"motion.parallax_", "motion.parallax_test", "false"},
    {"difference.", "motion.method", "vectors"},
    {"clustering.velocity_noise_limit", "clustering.velocity_noise_factor", "0"},
    {"clustering.max_min_members", "clustering.min_density_share", "0"},
    {"gradient.quantile_margin", "gradient.quantile_area", "roi"},
    {"gradient.support_share", "gradient.need_support", "false"},
    {"gradient.core_margin", "gradient.handle_cut", "false"},
    {"gradient.vehicle_", "gradient.join_components", "false"},
    {"gradient.fall_back_share", "gradient.fall_back", "false"},
    {"sliding_window.descriptor", "sliding_window.descriptor", ""},
    {"sliding_window.support_share", "sliding_window.need_support", "false"},
    {"window_and_gradient.", "detection.method", "gradient"},
    {"duplicates.velocity_", "duplicates.compare_speed", "false"},
    {"duplicates.part_", "duplicates.join_parts", "false"},
    {"outliers.max_min_vectors", "outliers.min_density_share", "0"},
    {"tracking.part_containment", "tracking.split_merge", "overlap_matrix"},
    {"tracking.split_patience", "tracking.split_merge", "overlap_matrix"},
    {"tracking.size_patience", "tracking.size_gate", "0"},
    {"tracking.supported_hits", "tracking.max_supported", "0"},
    {"tracking.max_stopped", "tracking.stop_speed", "0"},
    {"tracking.appearance_", "tracking.appearance", "none"},
    {"tracking.max_hidden", "tracking.appearance", "none"},
    {"tracking.max_standing", "tracking.appearance", "none"},
    {"tracking.duplicate_", "tracking.suppress_duplicates", "false"},
    {"finishing.stop_speed", "finishing.trim_predicted", "false"},
    {"finishing.join_distance_", "finishing.join_gap", "0"},
    {"finishing.size_window", "finishing.constant_size", "false"},
    {"finishing.smooth_window", "finishing.smooth_path", "false"},
};

/// … or they belong to a method that the text names without its numbers.
const std::set<std::string> kLeftOpenByTheText{
    // Förstner-Harris corners, tracked by gradient descent in a small area (§4.2).
    "registration.max_corners", "registration.min_corner_distance", "registration.tensor_window",
    "registration.max_residual", "registration.max_speed", "registration.max_jerk", "registration.patch_life",
    "registration.patch_deformation",
    // RANSAC with refinement (§4.2).
    "registration.inlier_distance", "registration.min_inliers", "registration.min_inlier_share",
    // Velocity from the track of a corner (§4.2).
    "motion.baseline",
    // Single linkage by position and velocity (§4.2).
    "clustering.velocity_share", "clustering.velocity_floor",
    // Video whose frames all can be registered.
    "tracking.max_failed",
    // The Kalman filter's noise (§6.5).
    "tracking.position_noise_px", "tracking.size_noise_px", "tracking.velocity_noise", "tracking.velocity_noise_px",
    // Words for tracks, which change none (§3).
    "classes.person_speed", "classes.two_wheeler_width", "classes.min_life"};

/// What asks for nothing where 0 does not.
const std::map<std::string, std::string> kAsksForNothing{
    {"clustering.min_members", "1"}, {"gradient.quantile_area", "roi"}, {"sliding_window.rejection_margin", "1000"},
    {"tracking.max_turn", "180"},    {"tracking.min_vectors", "1"},     {"tracking.appearance", "none"},
    {"finishing.max_sharing", "1"},
};

TEST(ChainOptions, theThesisPresetLeavesNoNumberOfOursInForce) {
    std::map<std::string, std::string> thesis;
    ChainOptions preset = builtInPreset("thesis");
    const auto parameters = listParameters(describeOf(preset));
    for (const Parameter& parameter : parameters) thesis[parameter.name] = parameter.value;
    std::set<std::string> open = kLeftOpenByTheText;
    std::map<std::string, std::string> nothing = kAsksForNothing;
    for (const Parameter& parameter : parameters) {
        if (parameter.kind == ParameterKind::flag || !parameter.text.source.empty()) continue;
        if (open.erase(parameter.name) > 0) continue;
        if (const auto asked = nothing.extract(parameter.name)) {
            EXPECT_EQ(parameter.value, asked.mapped()) << parameter.name;
            continue;
        }
        if (parameter.value == "0") continue;
        const auto owner = std::find_if(kOfWhatIsOff.begin(), kOfWhatIsOff.end(), [&](const auto& entry) {
            return parameter.name.rfind(std::get<0>(entry), 0) == 0;
        });
        ASSERT_NE(owner, kOfWhatIsOff.end())
            << parameter.name << " is our own: the preset switches it off, or it is told here why it need not";
        EXPECT_EQ(thesis.at(std::get<1>(*owner)), std::get<2>(*owner)) << parameter.name;
    }
    EXPECT_TRUE(open.empty()) << *open.begin() << " is no such parameter";
    EXPECT_TRUE(nothing.empty()) << nothing.begin()->first << " is no such parameter";
}

/// What the text says of parameters that name their place in it, or that they are an addition to what stands there.
const std::map<std::string, std::string> kAsTheTextSays{
    {"motion.min_age", "5"},    // frames that a corner is tracked (§4.2)
    {"motion.areas", "false"},  // an addition: the text has difference images or corners, never both
    {"motion.method", "vectors"},
    {"difference.gap", "3"},    // fig. 4.2
    {"clustering.along", "3"},  // one distance in every direction
    {"clustering.across", "3"},
    {"stacking.enabled", "true"},
    {"stacking.initialisation", "detections"},  // the better one of §7.3.4, and so the three below
    {"stacking.arrangement", "circular_median"},
    {"stacking.capacity", "50"},
    {"stacking.min_height", "25"},
    {"stacking.area_length", "119"},  // 345 px at 0.345 m/px
    {"stacking.area_width", "39.7"},  // 115 px
    {"stacking.neighbours", "3"},
    {"stacking.follow_lone_vectors", "true"},
    {"detection.method", "gradient"},
    {"detection.extend_along", "2"},
    {"detection.extend_across", "1.25"},
    {"gradient.method", "lbp"},
    {"gradient.quantile", "0"},  // the optimum of table 7.3
    {"gradient.canny_variance", "0.5"},
    {"gradient.min_box_area", "10"},
    {"relative_connectivity.deviations", "1.2"},
    {"relative_connectivity.min_points", "3"},
    {"relative_connectivity.low", "40"},
    {"relative_connectivity.high_factor", "2"},
    {"sliding_window.model", "thesis"},
    {"sliding_window.rescaling", "length_3"},
    {"sliding_window.middle_scale", "1"},       // the original image …
    {"sliding_window.smallest_scale", "0.85"},  // … one for smaller cars …
    {"sliding_window.largest_scale", "3.8"},    // … and one for vehicles of 15 to 20 m
    {"sliding_window.overlap_threshold", "0.1"},
    {"mser.keep_spanning", "true"},  // to leave them out is an addition
    {"duplicates.strategy", "by_detector"},
    {"duplicates.measure", "overlap"},
    {"outliers.min_vectors", "4"},
    {"outliers.vector_margin", "0"},  // an addition
    {"outliers.min_area", "10"},
    {"outliers.inside_image", "true"},
    {"tracking.min_overlap", "0.5"},
    {"tracking.split_merge", "overlap_matrix"},
    {"tracking.use_vectors", "true"},
    {"tracking.vectors_first", "true"},
    {"tracking.rebuilt_size", "stored"},
    {"tracking.max_vectors", "20"},
    {"tracking.relative_position_gain", "1"},
    {"tracking.max_reconstructed", "10"},
    {"tracking.suppress_duplicates", "false"},  // an idea of the outlook (§8.2)
    {"finishing.keep_tentative", "true"},
};

/// Parameters whose place in the text names them without a value, or to which it refers.
const std::set<std::string> kNamedWithoutAValue{
    // The density of corners, what makes one, and the area in which it is tracked (§4.2; Förstner and Gülch 1987).
    "registration.corner_spacing", "registration.corner_deviation", "registration.min_roundness", "registration.window",
    // The speed of independent motion (§4.2).
    "motion.min_speed",
    // Difference images (§2.2).
    "difference.background_frames", "difference.gradient_suppression", "difference.blur", "difference.strong_limit",
    "difference.opening", "difference.closing", "difference.ghost_deviation", "difference.ghost_gradient",
    // Alike motion of stacks and clusters; how long a usual vehicle is (§5.3).
    "stacking.max_speed_difference", "stacking.max_turn", "stacking.vehicle_length",
    // Radii and threshold of LBP (§5.4.1).
    "gradient.lbp_radius_min", "gradient.lbp_radius_max", "gradient.lbp_threshold",
    // The median car, and T_d, which fig. 7.8 varies (§5.4.3).
    "sliding_window.car_length", "sliding_window.car_width", "sliding_window.decision_threshold",
    // Methods of the literature (§7.4.1).
    "tophat_otsu.element", "tophat_otsu.smoothing", "mser.delta", "mser.max_variation", "mser.min_area",
    "mser.max_area", "mser.max_eccentricity", "canny_harris.high", "canny_harris.low_share",
    "canny_harris.corner_share", "canny_harris.link", "canny_harris.min_corners", "canny_harris.closing",
    // "Similar orientation and strong overlap" (§5.5.1).
    "duplicates.threshold", "duplicates.max_turn",
    // "Similar motion" (§6.2.2), the life of a track (§6.4), the Kalman filter's noise (§6.5).
    "tracking.vector_speed_difference", "tracking.confirm_hits", "tracking.confirm_window",
    "tracking.max_missing_tentative", "tracking.max_missing", "tracking.acceleration", "tracking.turn_rate",
    "tracking.size_rate", "tracking.position_noise_m", "tracking.size_noise_m", "tracking.heading_noise",
    // What persons and two-wheelers are called (§3), which changes no track.
    "classes.person_size", "classes.two_wheeler_length"};

TEST(ChainOptions, OfEveryParameterItIsDecidedWhatTheThesisSaysOfIt) {
    ChainOptions preset = builtInPreset("thesis");
    std::map<std::string, std::string> said = kAsTheTextSays;
    std::set<std::string> open = kNamedWithoutAValue;
    for (const Parameter& parameter : listParameters(describeOf(preset))) {
        // Those without a place in the text: theThesisPresetLeavesNoNumberOfOursInForce, …SwitchesEveryAdditionOff.
        if (parameter.text.source.empty() || open.erase(parameter.name) > 0) continue;
        const auto asked = said.extract(parameter.name);
        ASSERT_FALSE(asked.empty()) << parameter.name << " (" << parameter.text.source << ") is in neither list: what "
                                    << "does the text say? An addition to it has the value that switches it off";
        EXPECT_EQ(parameter.value, asked.mapped()) << parameter.name;
    }
    EXPECT_TRUE(open.empty()) << *open.begin() << " is no such parameter, or has no source";
    EXPECT_TRUE(said.empty()) << said.begin()->first << " is no such parameter, or has no source";
}

TEST(ChainOptions, theThesisPresetDiffersFromTheDefaultsWhereItMust) {
    const std::vector<std::pair<std::string, std::string>> expected{
        {"view.oblique", "false"},
        {"registration.max_corners", "50000"},
        {"registration.favour_movers", "false"},
        {"registration.recovery_frames", "0"},
        {"registration.feature_search", "false"},
        {"motion.baseline", "5"},
        {"motion.min_speed_px", "0"},
        {"motion.sigma_factor", "0"},
        {"motion.noise_cell", "0"},
        {"motion.follow_rate", "false"},
        {"motion.follow_turns", "false"},
        {"motion.shadow_test", "false"},
        {"motion.silhouettes", "false"},
        {"motion.areas", "false"},
        {"motion.parallax_test", "false"},
        {"motion.max_speed", "0"},
        {"difference.gap", "3"},
        {"clustering.along", "3"},
        {"clustering.across", "3"},
        {"clustering.roof_length", "0"},
        {"clustering.min_distance", "0"},
        {"clustering.min_distance_far", "0"},
        {"clustering.velocity_share", "0.1"},
        {"clustering.velocity_noise_factor", "0"},
        {"clustering.min_members", "1"},
        {"clustering.min_density_share", "0"},
        {"clustering.margin", "0"},
        {"clustering.split_width", "0"},
        {"clustering.max_length", "0"},
        {"clustering.max_width", "0"},
        {"stacking.enabled", "true"},
        {"stacking.follow_lone_vectors", "true"},
        {"detection.method", "gradient"},
        {"detection.min_roi_length", "0"},
        {"detection.min_roi_width", "0"},
        {"detection.min_roi_length_px", "0"},
        {"detection.min_roi_width_px", "0"},
        {"detection.cluster_margin", "0"},
        {"gradient.quantile", "0"},
        {"gradient.quantile_area", "roi"},
        {"gradient.need_support", "false"},
        {"gradient.handle_cut", "false"},
        {"gradient.join_components", "false"},
        {"gradient.growth_along", "0"},
        {"gradient.growth_across", "0"},
        {"gradient.length_correction", "0"},
        {"gradient.width_correction", "0"},
        {"gradient.fall_back", "false"},
        {"relative_connectivity.deviations", "1.2"},
        {"relative_connectivity.low", "40"},
        {"relative_connectivity.car_length", "0"},
        {"sliding_window.model", "thesis"},
        {"sliding_window.need_support", "false"},
        {"sliding_window.middle_scale", "1"},
        {"sliding_window.largest_scale", "3.8"},
        {"sliding_window.decision_threshold", "30"},
        {"sliding_window.rejection_margin", "1000"},
        {"sliding_window.context", "0"},
        {"tophat_otsu.min_contrast", "0"},
        {"tophat_otsu.joining", "0"},
        {"mser.keep_spanning", "true"},
        {"duplicates.measure", "overlap"},
        {"duplicates.threshold", "0.2"},
        {"duplicates.compare_speed", "false"},
        {"duplicates.growth_limit", "0"},
        {"duplicates.join_parts", "false"},
        {"outliers.min_vectors", "4"},
        {"outliers.min_density_share", "0"},
        {"outliers.compare_velocity", "false"},
        {"outliers.min_length", "0"},
        {"outliers.max_length", "0"},
        {"outliers.max_width", "0"},
        {"outliers.vector_margin", "0"},
        {"outliers.inside_image", "true"},
        {"tracking.min_overlap", "0.5"},
        {"tracking.distance_gate_m", "0"},
        {"tracking.distance_gate_px", "0"},
        {"tracking.max_turn", "180"},
        {"tracking.split_merge", "overlap_matrix"},
        {"tracking.follow_rate", "false"},
        {"tracking.confirm_whole", "0"},
        {"tracking.size_gate", "0"},
        {"tracking.one_vehicle", "0"},
        {"tracking.min_vectors", "1"},
        {"tracking.relative_position_gain", "1"},
        {"tracking.max_supported", "0"},
        {"tracking.stop_speed", "0"},
        {"tracking.suppress_duplicates", "false"},
        {"tracking.car_length", "0"},
        {"tracking.car_width", "0"},
        {"tracking.min_visible", "0"},
        {"tracking.slow_speed", "0"},
        {"tracking.visible_overlap", "false"},
        {"tracking.max_leaving", "0"},
        {"tracking.appearance", "none"},
        {"tracking.measure_velocity", "false"},
        {"tracking.complete_at_border", "false"},
        {"tracking.adapt_size", "false"},
        {"tracking.agreement", "0"},
        {"tracking.vectors_first", "true"},
        {"tracking.rebuilt_size", "stored"},
        {"finishing.trim_predicted", "false"},
        {"finishing.join_gap", "0"},
        {"finishing.constant_size", "false"},
        {"finishing.smooth_path", "false"},
        {"finishing.extend_back", "0"},
        {"finishing.extend_entry", "0"},
        {"finishing.trace_back", "0"},
        {"finishing.follow_ends", "0"},
        {"finishing.from_rest", "0"},
        {"finishing.min_length", "0"},
        {"finishing.min_width", "0"},
        {"registration.leave_out_graphics", "false"},
        {"finishing.max_aspect", "0"},
        {"finishing.max_sharing", "1"},
        {"finishing.drop_shadows", "false"},
        {"finishing.trim_shadows", "false"},
        {"finishing.whole_lorries", "false"},
        {"finishing.min_detected", "0"},
        {"finishing.standing_height", "0"},
        {"finishing.standing_depth", "0"},
        {"finishing.roof_height", "0"},
        {"finishing.min_score", "0"},
        {"finishing.join_parts", "false"},
    };
    const auto plain = parameterValues(ChainOptions{});
    const auto thesis = parameterValues(builtInPreset("thesis"));
    ASSERT_EQ(plain.size(), thesis.size());
    std::map<std::string, std::string> differences;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        if (plain[i].second != thesis[i].second) differences[thesis[i].first] = thesis[i].second;
    }
    EXPECT_EQ(differences, (std::map<std::string, std::string>(expected.begin(), expected.end())));
}

}  // namespace eyrie::chain_options_test
