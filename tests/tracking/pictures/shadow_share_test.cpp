// How much of a shadow a box holds, on numbers that can be followed by hand.
#include "tracking/pictures/shadow_share.h"

#include <gtest/gtest.h>

namespace eyrie::shadow_share_test {
namespace {

/// A box of 24 × 12 px.
SilhouetteLook lookAt(double heading, const BoxEdges& whole, std::optional<BoxEdges> lit) {
    SilhouetteLook look;
    look.box = {{100, 50}, 24, 12, heading};
    look.silhouette = {whole, lit, lit.has_value()};
    return look;
}

constexpr BoxEdges kCar{-9, 9, -4, 4};

}  // namespace

TEST(ShadowShare, IsWhatTheBoxHoldsOfTheReachAlongTheHeading) {
    // The shadow goes from 9 to 15 px before the middle, the box to 12.
    const ShadowShare before = shareInBox(lookAt(0, {-9, 15, -4, 4}, kCar), {6, 0}, 0.15);
    EXPECT_NEAR(before.along.value(), 0.5, 1e-9);
    EXPECT_FALSE(before.across);
    // The same shadow of a vehicle that drives the other way falls behind it.
    const ShadowShare behind = shareInBox(lookAt(CV_PI, {-15, 9, -4, 4}, kCar), {6, 0}, 0.15);
    EXPECT_NEAR(behind.along.value(), 0.5, 1e-9);
    EXPECT_FALSE(behind.across);
}

TEST(ShadowShare, IsWhatTheBoxHoldsOfTheReachAcrossTheHeading) {
    const ShadowShare right = shareInBox(lookAt(0, {-9, 9, -4, 9}, kCar), {0, 5}, 0.15);
    EXPECT_NEAR(right.across.value(), 0.4, 1e-9);
    EXPECT_FALSE(right.along);
    const ShadowShare left = shareInBox(lookAt(0, {-9, 9, -9, 4}, kCar), {0, -5}, 0.15);
    EXPECT_NEAR(left.across.value(), 0.4, 1e-9);
    EXPECT_FALSE(left.along);
    // Right on the screen is left of what drives downwards.
    const ShadowShare down = shareInBox(lookAt(CV_PI / 2, {-9, 9, -9, 4}, kCar), {5, 0}, 0.15);
    EXPECT_NEAR(down.across.value(), 0.4, 1e-9);
}

TEST(ShadowShare, BeginsWhereTheReachSaysButNotBeforeWhatIsLit) {
    EXPECT_NEAR(shareInBox(lookAt(0, {-9, 15, -4, 4}, {}), {6, 0}, 0.15).along.value(), 0.5, 1e-9);
    const BoxEdges longer{-10.5, 10.5, -5.5, 5.5};
    EXPECT_NEAR(shareInBox(lookAt(0, {-9, 15, -4, 4}, longer), {6, 0}, 0.15).along.value(), 0.25, 1e-9);
    EXPECT_NEAR(shareInBox(lookAt(0, {-15, 9, -4, 4}, longer), {-6, 0}, 0.15).along.value(), 0.25, 1e-9);
    EXPECT_NEAR(shareInBox(lookAt(0, {-9, 9, -4, 9}, longer), {0, 5}, 0.15).across.value(), 0.1, 1e-9);
    EXPECT_NEAR(shareInBox(lookAt(0, {-9, 9, -9, 4}, longer), {0, -5}, 0.15).across.value(), 0.1, 1e-9);
}

TEST(ShadowShare, IsNeverLessThanNothingNorMoreThanAll) {
    EXPECT_EQ(shareInBox(lookAt(0, {-9, 24, -4, 4}, {}), {6, 0}, 0.15).along.value(), 0);
    EXPECT_EQ(shareInBox(lookAt(0, {-9, 9, -4, 4}, {}), {6, 0}, 0.15).along.value(), 1);
}

TEST(ShadowShare, SaysNothingOfAnAxisOnWhichHardlyAnyOfItFalls) {
    const SilhouetteLook look = lookAt(0, {-9, 15, -4, 8}, kCar);
    const auto says = [&](cv::Point2d reach) {
        const ShadowShare share = shareInBox(look, reach, 0.15);
        return std::pair(share.along.has_value(), share.across.has_value());
    };
    for (const double sign : {1.0, -1.0}) {
        EXPECT_EQ(says({sign * 10, 1.2}), std::pair(true, false));
        EXPECT_EQ(says({1.2, sign * 10}), std::pair(false, true));
        EXPECT_EQ(says({10, sign * 1.7}), std::pair(true, true));
        EXPECT_EQ(says({sign * 1.7, 10}), std::pair(true, true));
    }
}

}  // namespace eyrie::shadow_share_test
