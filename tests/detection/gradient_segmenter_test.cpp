#include "detection/gradient_segmenter.h"

#include <gtest/gtest.h>

#include "detection/detection_options.h"
#include "support/driven_scene.h"

namespace eyrie {
namespace {

using test::drivenScene;
using test::kContractScale;
using test::roiOf;

GradientSegmenter segmenter(const GradientOptions& options) {
    return {options, kContractScale, 0.5};
}

TEST(GradientOptions, ThesisHasTheOptimaOfTable73) {
    EXPECT_DOUBLE_EQ(GradientOptions::thesis().quantile, 0.12);
    EXPECT_DOUBLE_EQ(GradientOptions::thesis(GradientMethod::simple).quantile, 0.15);
    EXPECT_DOUBLE_EQ(GradientOptions::thesis(GradientMethod::canny).quantile, 0.14);
    EXPECT_DOUBLE_EQ(GradientOptions::thesis(GradientMethod::morphological).quantile, 0.16);
    EXPECT_EQ(GradientOptions::thesis().quantile_area, QuantileArea::roi);
}

TEST(GradientSegmenter, TracesAllItsSteps) {
    DetectionTrace trace;
    segmenter({}).detect(roiOf(drivenScene(0.4)), &trace);
    std::vector<std::string> names;
    for (const auto& layer : trace.layers) names.push_back(layer.name);
    EXPECT_EQ(names, (std::vector<std::string>{"raw", "gradient", "lbp mask", "binary", "closed", "components"}));
}

TEST(GradientSegmenter, FallsBackToTheClusterWhereNothingIsSeen) {
    auto scene = drivenScene(0.4);
    scene.frame.gray.setTo(100);
    GradientOptions options;
    const auto with = segmenter(options).detect(roiOf(scene));
    ASSERT_EQ(with.size(), 1U);
    EXPECT_GT(overlap(with[0].box, scene.cluster.box), 0.9);
    options.fall_back = false;
    EXPECT_TRUE(segmenter(options).detect(roiOf(scene)).empty());
}

TEST(GradientSegmenter, BoxesAreTrueToTheVehicle) {
    // The mean over placements; without bias correction LBP boxes come out up to a radius too wide.
    double length = 0;
    double width = 0;
    int count = 0;
    for (int i = 0; i < 16; ++i) {
        const auto scene = drivenScene(0.4 * i, {150 + 0.37 * i, 118 + 0.61 * i}, static_cast<std::uint64_t>(i + 1));
        GradientOptions options;
        options.fall_back = false;
        const auto detections = segmenter(options).detect(roiOf(scene));
        ASSERT_EQ(detections.size(), 1U);
        EXPECT_GT(overlap(detections[0].box, scene.vehicle), 0.75);
        length += detections[0].box.length;
        width += detections[0].box.width;
        ++count;
    }
    EXPECT_NEAR(length / count, 40, 2.0);
    EXPECT_NEAR(width / count, 16, 2.0);
}

TEST(GradientSegmenter, PaddingIsNotAnEdge) {
    // Half of the vehicle has left the image: no box may reach far beyond it.
    const auto scene = drivenScene(0, {318, 120});
    GradientOptions options;
    options.fall_back = false;
    for (const Detection& detection : segmenter(options).detect(roiOf(scene))) {
        EXPECT_LT(detection.box.centre.x + detection.box.length / 2, 322);
    }
}

}  // namespace
}  // namespace eyrie
