#include "core/values/scale_slope.h"

#include <gtest/gtest.h>

#include "core/values/scale_basis.h"
#include "core/values/scene_scale.h"

namespace eyrie::scale_slope_test {
namespace {

// A picture of 201 × 101 px whose middle is (100, 50); pixels per metre grow by 1 % for a pixel downwards.
const ScaleSlope kTilted = ScaleSlope::ofPicture({201, 101}, 0, 0.01);

TEST(ScaleSlope, PixelsPerMetreGrowWithTheDistanceFromTheHorizon) {
    EXPECT_EQ(kTilted.factorAt({100, 50}), 1);
    EXPECT_EQ(kTilted.factorAt({0, 50}), 1) << "the horizon is level";
    EXPECT_DOUBLE_EQ(kTilted.factorAt({100, 100}), 1.5);
    EXPECT_DOUBLE_EQ(kTilted.factorAt({100, 0}), 0.5);
    const ScaleSlope both = ScaleSlope::ofPicture({201, 101}, -0.002, 0.01);
    EXPECT_DOUBLE_EQ(both.factorAt({150, 60}), 1.0);
    EXPECT_DOUBLE_EQ(both.factorAt({50, 60}), 1.2);
}

TEST(ScaleSlope, CountedFromAnotherPlaceItIsTheSame) {
    const ScaleSlope middle = ScaleSlope::ofPicture({640, 360}, 0.0005, 0.003);
    const ScaleSlope there = middle.countedFrom({100, 250});
    EXPECT_EQ(there.centre(), cv::Point2d(100, 250));
    for (const cv::Point2d place : {cv::Point2d(100, 250), cv::Point2d(500, 90), cv::Point2d(319.5, 179.5)})
        EXPECT_NEAR(there.factorAt(place), middle.factorAt(place) / middle.factorAt({100, 250}), 1e-12);
    const ScaleSlope back = there.countedFrom(middle.centre());
    EXPECT_NEAR(back.right_per_px, middle.right_per_px, 1e-12);
    EXPECT_NEAR(back.down_per_px, middle.down_per_px, 1e-12);
}

TEST(ScaleSlope, BeyondTheHorizonNothingGrowsOrShrinksFurther) {
    EXPECT_EQ(kTilted.factorAt({100, -1000}), ScaleSlope::kLeast);
    EXPECT_EQ(kTilted.factorAt({100, 9999}), ScaleSlope::kMost);
}

TEST(ScaleSlope, AScaleAtAPlaceTurnsLengthsAndSpeedsThere) {
    SceneScale scale{0.2, 25, true};
    scale.slope = kTilted;
    const SceneScale below = scale.at({100, 100});
    EXPECT_TRUE(below.slope.isFlat());
    EXPECT_TRUE(below.gsd_known);
    EXPECT_DOUBLE_EQ(below.px(2), 15) << "10 px in the middle";
    EXPECT_DOUBLE_EQ(below.metres(15), 2);
    EXPECT_DOUBLE_EQ(below.pxPerFrame(10), 3);
    EXPECT_DOUBLE_EQ(scale.at({100, 0}).metresPerSecond(1), 10);
}

TEST(ScaleSlope, WhereItIsFlatEveryPlaceHasTheScaleToTheLastBit) {
    const SceneScale scale{0.1 + 0.2, 30, false};
    for (const cv::Point2d place : {cv::Point2d(0, 0), cv::Point2d(1e6, -7.3)}) {
        EXPECT_EQ(scale.at(place).gsd_m_per_px, scale.gsd_m_per_px);
        EXPECT_EQ(scale.at(place).px(4.5), scale.px(4.5));
    }
}

TEST(ScaleSlope, TheScaleOfAnObliqueViewIsToldWithItsEdges) {
    SceneScale scale{0.2, 25, true};
    EXPECT_EQ(describe(scale, {ScaleOrigin::given}, {201, 101}), "0.2 m/px, as given");
    scale.slope = kTilted;
    EXPECT_EQ(describe(scale, {ScaleOrigin::given}, {201, 101}),
              "0.2 m/px in the middle of an oblique view (0.4 at its upper edge, 0.13 at its lower edge), from what "
              "was given");
    scale.slope = ScaleSlope::ofPicture({201, 101}, -0.002, 0.01);
    EXPECT_EQ(describe(scale, {ScaleOrigin::given}, {201, 101}),
              "0.2 m/px in the middle of an oblique view (0.4 at its upper edge, 0.13 at its lower edge), from what "
              "was given")
        << "along the axis over which it changes more";
    // In a few pixels each counts: the edges are looked at in their middle.
    scale.slope = ScaleSlope::ofPicture({5, 3}, 0.2, 0.5);
    EXPECT_EQ(describe(scale, {ScaleOrigin::given}, {5, 3}),
              "0.2 m/px in the middle of an oblique view (0.4 at its upper edge, 0.13 at its lower edge), from what "
              "was given");
    scale.slope = ScaleSlope::ofPicture({3, 5}, -0.5, 0.2);
    EXPECT_EQ(describe(scale, {ScaleOrigin::given}, {3, 5}),
              "0.2 m/px in the middle of an oblique view (0.13 at its left edge, 0.4 at its right edge), from what was "
              "given");
    scale.slope = ScaleSlope::ofPicture({201, 101}, 0.005, -0.002);
    EXPECT_EQ(describe(scale, {ScaleOrigin::given}, {201, 101}),
              "0.2 m/px in the middle of an oblique view (0.4 at its left edge, 0.13 at its right edge), from what was "
              "given");
    scale.slope = ScaleSlope::ofPicture({201, 101}, 0.005, 0);
    EXPECT_EQ(describe(scale, {ScaleOrigin::given}, {201, 101}),
              "0.2 m/px in the middle of an oblique view (0.4 at its left edge, 0.13 at its right edge), from what was "
              "given");
}

}  // namespace
}  // namespace eyrie::scale_slope_test
