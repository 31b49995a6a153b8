#include "motion/vectors/shadow_test.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace eyrie::shadow_test_test {
namespace {

const SceneScale kScale{0.3, 25, true};

/// Road of brightness 140 with a dark patch and a bright one.
cv::Mat road(int ground, int patch) {
    cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(ground));
    gray(cv::Rect(100, 100, 16, 8)).setTo(patch);
    return gray;
}

bool shadowAtCorner(const cv::Mat& gray, cv::Point2f corner = {100, 100}, const ShadowTestOptions& options = {}) {
    ShadowTest test(options, kScale);
    test.prepare(gray);
    return test.isShadow(corner);
}

TEST(ShadowTest, TellsHalfDarkFromBrightAndBlack) {
    EXPECT_TRUE(shadowAtCorner(road(140, 80)));    // 0.57 of the ground
    EXPECT_FALSE(shadowAtCorner(road(140, 25)));   // black paint
    EXPECT_FALSE(shadowAtCorner(road(140, 200)));  // bright paint
    EXPECT_FALSE(shadowAtCorner(road(140, 130)));  // hardly darker than the road
}

TEST(ShadowTest, ABrightRoofBesideTheShadowSavesTheCorner) {
    cv::Mat gray = road(140, 80);
    gray(cv::Rect(96, 96, 4, 16)).setTo(220);
    EXPECT_FALSE(shadowAtCorner(gray));
}

/// Whether lit ground parts the dark patch from a vehicle whose lower edge is `gap` px above it.
bool litAcross(int gap, int between, const ShadowTestOptions& options = {}) {
    cv::Mat gray = road(140, 80);
    gray(cv::Rect(100, 100 - gap, 16, gap)).setTo(between);
    ShadowTest test(options, kScale);
    test.prepare(gray);
    const OrientedBox vehicle{{107.5, 100.0 - gap - 4}, 16, 8, 0};
    return test.litUpTo(vehicle, {108, 107});
}

TEST(ShadowTest, AShadowReachesUpToItsVehicleAndADarkCarInTheNextLaneDoesNot) {
    EXPECT_FALSE(litAcross(0, 80)) << "the shadow begins at the vehicle";
    EXPECT_FALSE(litAcross(3, 80)) << "… which is larger than the box of its corners";
    EXPECT_TRUE(litAcross(3, 140)) << "the road shines between";
    EXPECT_FALSE(litAcross(3, 220)) << "a bright edge of the vehicle is no road";
}

TEST(ShadowTest, LimitsAreSharesOfTheGround) {
    // The patch has 80 / 140 = 0.57 of the ground's brightness.
    const struct {
        const char* parameter;
        const char* shadow;
        const char* none;
    } limits[] = {{"motion.shadow_darkest", "0.55", "0.6"},
                  {"motion.shadow_brightest", "0.6", "0.55"},
                  {"motion.shadow_bright_near", "1.05", "0.95"},
                  {"motion.shadow_min_brightness", "135", "145"},
                  // The window must hold more road than patch: 5 m and 2.4 m long.
                  {"motion.shadow_ground", "12", "1"}};
    for (const auto& limit : limits) {
        ShadowTestOptions options;
        setParameter(describeOf(options), limit.parameter, limit.shadow);
        EXPECT_TRUE(shadowAtCorner(road(140, 80), {104, 100}, options)) << limit.parameter;
        setParameter(describeOf(options), limit.parameter, limit.none);
        EXPECT_FALSE(shadowAtCorner(road(140, 80), {104, 100}, options)) << limit.parameter;
    }
    ShadowTestOptions wide;
    cv::Mat roof_near = road(140, 80);
    roof_near(cv::Rect(90, 90, 30, 6)).setTo(220);  // from 4 px beside the corner on
    EXPECT_TRUE(shadowAtCorner(roof_near, {104, 100}, wide));
    wide.shadow_radius_m = 1.8;  // 6 px
    EXPECT_FALSE(shadowAtCorner(roof_near, {104, 100}, wide));
    ShadowTestOptions never;
    never.shadow_lit = 1.1;
    EXPECT_TRUE(litAcross(3, 140));
    EXPECT_FALSE(litAcross(3, 140, never));
}

TEST(ShadowTest, FourPixelsDecideAndASingleOneDoesNot) {
    for (const auto& [size, decides] :
         {std::pair{cv::Size(1, 1), false}, {cv::Size(2, 1), false}, {cv::Size(1, 2), false}, {cv::Size(2, 2), true}}) {
        cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(140));
        gray(cv::Rect({100, 100}, size)).setTo(63);  // 0.45 of the road; with a pixel of it 0.59
        ShadowTestOptions options;
        options.shadow_brightest = 0.5;
        EXPECT_EQ(shadowAtCorner(gray, {100, 100}, options), decides) << size;
        gray = road(140, 80);
        gray(cv::Rect({100, 100}, size)).setTo(185);  // half of it and half road are 1.16 of the road
        EXPECT_EQ(shadowAtCorner(gray, {101, 101}), !decides) << size;
    }
}

TEST(ShadowTest, IsNotUsedAtNight) {
    EXPECT_FALSE(shadowAtCorner(road(40, 22)));
}

TEST(ShadowTest, DoesNotDependOnExposure) {
    EXPECT_TRUE(shadowAtCorner(road(100, 57)));
    EXPECT_TRUE(shadowAtCorner(road(220, 125)));
}

TEST(ShadowTest, TakesImageEdgesTinyAndMissingImages) {
    EXPECT_FALSE(shadowAtCorner(road(140, 140), {0, 0}));
    EXPECT_FALSE(shadowAtCorner(road(140, 140), {319, 239}));
    EXPECT_FALSE(shadowAtCorner(road(140, 140), {-50, 900}));
    EXPECT_FALSE(shadowAtCorner(cv::Mat(), {5, 5}));
    EXPECT_FALSE(shadowAtCorner(cv::Mat(2, 2, CV_8UC1, cv::Scalar(100)), {0, 0}));
}

}  // namespace
}  // namespace eyrie::shadow_test_test
