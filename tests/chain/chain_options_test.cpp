#include "chain/chain_options.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

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

TEST(ChainOptions, theThesisPresetDiffersFromTheDefaultsWhereItMust) {
    const std::vector<std::pair<std::string, std::string>> expected{
        {"view.oblique", "false"},
        {"registration.max_corners", "50000"},
        {"registration.favour_movers", "false"},
        {"registration.feature_search", "false"},
        {"motion.baseline", "5"},
        {"motion.sigma_factor", "0"},
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
        {"clustering.velocity_share", "0.1"},
        {"clustering.velocity_noise_factor", "0"},
        {"clustering.min_members", "4"},
        {"clustering.min_density_share", "0"},
        {"clustering.margin", "0"},
        {"clustering.split_width", "0"},
        {"clustering.max_length", "0"},
        {"clustering.max_width", "0"},
        {"stacking.enabled", "true"},
        {"detection.method", "gradient"},
        {"detection.min_roi_length", "0"},
        {"detection.min_roi_width", "0"},
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
        {"sliding_window.rejection_margin", "1000"},
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
        {"finishing.from_rest", "0"},
        {"finishing.min_length", "0"},
        {"finishing.min_width", "0"},
        {"finishing.max_sharing", "1"},
        {"finishing.drop_shadows", "false"},
        {"finishing.min_detected", "0"},
        {"finishing.standing_height", "0"},
        {"finishing.standing_depth", "0"},
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
