#include "detection/segmenters/gradient_segmenter.h"

#include <gtest/gtest.h>

#include "detection/detection_options.h"
#include "support/driven_scene.h"

namespace eyrie::gradient_segmenter_test {
namespace {

using test::drivenScene;
using test::kContractScale;
using test::roiOf;

GradientSegmenter segmenter(const GradientOptions& options) {
    return {options, kContractScale, 0.5};
}

TEST(GradientOptions, ThesisHasTheOptimaOfTable73) {
    EXPECT_DOUBLE_EQ(GradientOptions::thesis().effectiveQuantile(), 0.12);
    EXPECT_DOUBLE_EQ(GradientOptions::thesis(GradientMethod::simple).effectiveQuantile(), 0.15);
    EXPECT_DOUBLE_EQ(GradientOptions::thesis(GradientMethod::canny).effectiveQuantile(), 0.14);
    EXPECT_DOUBLE_EQ(GradientOptions::thesis(GradientMethod::morphological).effectiveQuantile(), 0.16);
    EXPECT_EQ(GradientOptions::thesis().quantile_area, QuantileArea::roi);
}

TEST(GradientOptions, TheQuantileFollowsTheMethodUntilOneIsChosen) {
    GradientOptions options = GradientOptions::thesis();
    options.method = GradientMethod::canny;
    EXPECT_DOUBLE_EQ(options.effectiveQuantile(), 0.14);
    options.quantile = 0.3;
    EXPECT_DOUBLE_EQ(options.effectiveQuantile(), 0.3);
    EXPECT_DOUBLE_EQ(GradientOptions{}.effectiveQuantile(), 0.35);
    // Two ways to the same boxes.
    GradientOptions chosen = GradientOptions::thesis(GradientMethod::simple);
    chosen.quantile = 0.15;
    const MotionRoi roi = roiOf(drivenScene(0.4));
    const auto follows = segmenter(GradientOptions::thesis(GradientMethod::simple)).detect(roi);
    const auto fixed = segmenter(chosen).detect(roi);
    ASSERT_EQ(follows.size(), fixed.size());
    ASSERT_FALSE(fixed.empty());
    for (std::size_t i = 0; i < fixed.size(); ++i) EXPECT_EQ(follows[i].box.area(), fixed[i].box.area());
}

TEST(GradientSegmenter, TracesAllItsSteps) {
    DetectionTrace trace;
    segmenter({}).detect(roiOf(drivenScene(0.4)), &trace);
    std::vector<TraceLayer> kinds;
    for (const auto& layer : trace.layers) kinds.push_back(layer.kind);
    EXPECT_EQ(kinds, (std::vector<TraceLayer>{TraceLayer::raw, TraceLayer::gradient, TraceLayer::lbp_mask,
                                              TraceLayer::quantile_area, TraceLayer::binary, TraceLayer::closed,
                                              TraceLayer::components}));
    EXPECT_EQ(trace.layers.back().boxes.size(), 1U);
}

TEST(GradientSegmenter, TheQuantileIsTakenAroundVectorsOnePixelAtLeast) {
    MotionRoi roi = roiOf(drivenScene(0.4));
    roi.vectors = {{20, 30}};
    GradientOptions options;
    const auto counted = [&](QuantileArea area, double margin_m) {
        options.quantile_area = area;
        options.quantile_margin_m = margin_m;
        DetectionTrace trace;
        segmenter(options).detect(roi, &trace);
        for (const auto& layer : trace.layers) {
            if (layer.kind == TraceLayer::quantile_area) return cv::countNonZero(layer.image);
        }
        return -1;
    };
    EXPECT_EQ(counted(QuantileArea::vectors, 0), 5) << "the pixel and those beside it";
    EXPECT_EQ(counted(QuantileArea::box, 0), 9);
    EXPECT_EQ(counted(QuantileArea::box, 2 * kContractScale.gsd_m_per_px), 25);
    roi.vectors = {{20, 30}, {25, 32}};
    EXPECT_EQ(counted(QuantileArea::box, 0), 8 * 5) << "from 19 to 26 and from 29 to 33";
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

/// Mean length and width over 16 placements of a vehicle of 40 × 16 px.
cv::Size2d meanSize(const GradientOptions& options) {
    cv::Size2d sum(0, 0);
    for (int i = 0; i < 16; ++i) {
        const auto scene = drivenScene(0.4 * i, {150 + 0.37 * i, 118 + 0.61 * i}, static_cast<std::uint64_t>(i + 1));
        const auto detections = segmenter(options).detect(roiOf(scene));
        EXPECT_EQ(detections.size(), 1U);
        if (detections.empty()) continue;
        EXPECT_GT(overlap(detections[0].box, scene.vehicle), 0.7);
        sum += cv::Size2d(detections[0].box.length, detections[0].box.width);
    }
    return {sum.width / 16, sum.height / 16};
}

TEST(GradientSegmenter, PatternsWidenBoxesByUpToTheirReach) {
    GradientOptions options;
    options.fall_back = false;
    const cv::Size2d raw = meanSize(options);
    // The patterns of radius 2 answer up to 2 px beside an edge, on both sides of the vehicle.
    EXPECT_GE(raw.width, 39.5);
    EXPECT_LE(raw.width, 44.5);
    EXPECT_GE(raw.height, 15.5);
    EXPECT_LE(raw.height, 20.5);
    options.length_correction = 1.5;
    options.width_correction = 1.5;
    const cv::Size2d corrected = meanSize(options);
    EXPECT_NEAR(corrected.width, 40, 1.5);
    EXPECT_NEAR(corrected.height, 16, 1.5);
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
}  // namespace eyrie::gradient_segmenter_test
