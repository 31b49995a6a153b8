#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <string>

#include "core/parameter.h"
#include "detection/detector_factory.h"
#include "support/driven_scene.h"

namespace eyrie::detection_parameters_test {
namespace {

/// A parameter, what it changes first, and two values of which the second leaves more of it.
struct DetectionEffect {
    DetectionMethod method;
    TraceLayer layer;
    const char* parameter;
    const char* less;
    const char* more;
};

/// Sum of a layer that the detector shows of a vehicle's search area.
double sumOf(const DetectionEffect& effect, const char* value) {
    DetectionOptions options;
    options.method = effect.method;
    if (effect.parameter == std::string("gradient.canny_variance")) options.gradient.method = GradientMethod::canny;
    if (effect.parameter == std::string("canny_harris.low_share"))
        options.canny_harris.high = 100;  // of the windows only
    setParameter(describeOf(options), effect.parameter, value);
    DetectionTrace trace;
    makeDetector(options, test::kContractScale)->detect(test::roiOf(test::drivenScene(0.4)), &trace);
    for (const auto& layer : trace.layers) {
        if (layer.kind == effect.layer) return cv::sum(layer.image)[0];
    }
    ADD_FAILURE() << "no such layer for " << effect.parameter;
    return 0;
}

class EveryDetectionParameter : public testing::TestWithParam<DetectionEffect> {};

}  // namespace

TEST_P(EveryDetectionParameter, DoesWhatItsHelpSays) {
    EXPECT_LT(sumOf(GetParam(), GetParam().less), sumOf(GetParam(), GetParam().more));
}

// The vehicle measures 40×16 px, 4.4×1.8 m and 7.7 m².
INSTANTIATE_TEST_SUITE_P(
    Each, EveryDetectionParameter,
    testing::Values(
        DetectionEffect{DetectionMethod::gradient, TraceLayer::gradient, "gradient.lbp_radius_min", "2", "1"},
        DetectionEffect{DetectionMethod::gradient, TraceLayer::gradient, "gradient.lbp_radius_max", "1", "3"},
        DetectionEffect{DetectionMethod::gradient, TraceLayer::gradient, "gradient.lbp_threshold", "30", "3"},
        DetectionEffect{DetectionMethod::gradient, TraceLayer::gradient, "gradient.canny_variance", "9", "0.3"},
        DetectionEffect{DetectionMethod::gradient, TraceLayer::quantile_area, "gradient.quantile_margin", "0.2", "0.6"},
        DetectionEffect{DetectionMethod::gradient, TraceLayer::binary, "gradient.quantile", "0.1", "0.3"},
        DetectionEffect{DetectionMethod::relative_connectivity, TraceLayer::bright_areas,
                        "relative_connectivity.high_factor", "30", "1"},
        DetectionEffect{DetectionMethod::relative_connectivity, TraceLayer::bright_areas, "relative_connectivity.low",
                        "40", "4"},
        DetectionEffect{DetectionMethod::relative_connectivity, TraceLayer::bright_areas,
                        "relative_connectivity.deviations", "1.5", "0"},
        DetectionEffect{DetectionMethod::relative_connectivity, TraceLayer::bright_lines,
                        "relative_connectivity.min_points", "12", "3"},
        DetectionEffect{DetectionMethod::tophat_otsu, TraceLayer::white_tophat, "tophat_otsu.element", "0.5", "3"},
        DetectionEffect{DetectionMethod::tophat_otsu, TraceLayer::white_tophat, "tophat_otsu.smoothing", "2.5", "0.3"},
        DetectionEffect{DetectionMethod::tophat_otsu, TraceLayer::binary, "tophat_otsu.min_contrast", "200", "8"},
        DetectionEffect{DetectionMethod::mser, TraceLayer::regions, "mser.delta", "100", "3"},
        DetectionEffect{DetectionMethod::mser, TraceLayer::regions, "mser.max_variation", "0.01", "1"},
        DetectionEffect{DetectionMethod::mser, TraceLayer::regions, "mser.min_area", "9", "2"},
        DetectionEffect{DetectionMethod::mser, TraceLayer::regions, "mser.max_area", "1", "12"},
        DetectionEffect{DetectionMethod::mser, TraceLayer::binary, "mser.max_eccentricity", "0.5", "0.99"},
        DetectionEffect{DetectionMethod::canny_harris, TraceLayer::edges, "canny_harris.high", "200", "20"},
        DetectionEffect{DetectionMethod::canny_harris, TraceLayer::edges, "canny_harris.low_share", "1", "0.05"},
        DetectionEffect{DetectionMethod::canny_harris, TraceLayer::corners, "canny_harris.corner_share", "0.9",
                        "0.001"},
        DetectionEffect{DetectionMethod::canny_harris, TraceLayer::clustered, "canny_harris.link", "0.1", "1"},
        DetectionEffect{DetectionMethod::canny_harris, TraceLayer::clustered, "canny_harris.min_corners", "1000", "1"},
        DetectionEffect{DetectionMethod::canny_harris, TraceLayer::closed, "canny_harris.closing", "0", "1"}),
    [](const auto& effect) {
        std::string name = effect.param.parameter;
        name.replace(name.find('.'), 1, "_");
        return name;
    });

}  // namespace eyrie::detection_parameters_test
