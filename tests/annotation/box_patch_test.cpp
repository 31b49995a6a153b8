#include "imaging/following/box_patch.h"

#include <gtest/gtest.h>

#include "annotation/scenes.h"

/// How alike the insides of boxes look.
namespace eyrie::box_patch_test {
namespace {

const OrientedBox kLorry{{60, 40}, 48, 12, 0};

cv::Mat texture() {
    return test::groundTexture({120, 80}, 4, 1.5, 60, 180);
}

/// Another thing lies in front of a part of the picture.
cv::Mat hidden(cv::Mat picture, const cv::Rect& part) {
    test::groundTexture(picture.size(), 9, 1.5, 60, 180)(part).copyTo(picture(part));
    return picture;
}

BoxPatch patchOf(const cv::Mat& picture, const OrientedBox& box) {
    return {picture, box, BoxPatch::samplesFor(box)};
}

}  // namespace

TEST(BoxPatch, HasASampleForEveryPixelWithinLimits) {
    EXPECT_EQ(BoxPatch::samplesFor(kLorry), cv::Size(48, 12));
    EXPECT_EQ(BoxPatch::samplesFor({{0, 0}, 300, 2, 0}), cv::Size(48, 6));
}

TEST(BoxPatch, DoesNotKnowBrightnessAndContrast) {
    const BoxPatch patch = patchOf(texture(), kLorry);
    cv::Mat other;
    texture().convertTo(other, -1, 0.5, 70);
    EXPECT_NEAR(patchOf(other, kLorry).correlation(patch), 1, 0.01);
    texture().convertTo(other, -1, -1, 240);
    EXPECT_NEAR(patchOf(other, kLorry).correlation(patch), -1, 0.01);
    EXPECT_EQ(patchOf(cv::Mat(80, 120, CV_8UC1, cv::Scalar(90)), kLorry).correlation(patch), 0);
    EXPECT_LT(patchOf(hidden(texture(), {0, 0, 120, 80}), kLorry).correlation(patch), 0.5);
}

TEST(BoxPatch, TurnsWithTheBox) {
    cv::Mat turned;
    cv::rotate(texture(), turned, cv::ROTATE_90_CLOCKWISE);
    const OrientedBox there{{79 - kLorry.centre.y, kLorry.centre.x}, 48, 12, CV_PI / 2};
    EXPECT_NEAR(patchOf(turned, there).correlation(patchOf(texture(), kLorry)), 1, 1e-3);
}

TEST(BoxPatch, IsSeenWhereNothingLiesInFront) {
    const BoxPatch whole = patchOf(texture(), kLorry);
    EXPECT_EQ(whole.seenOf(whole), 1);
    EXPECT_LT(patchOf(hidden(texture(), {0, 0, 120, 80}), kLorry).seenOf(whole), 0.15) << "by chance";
    EXPECT_NEAR(patchOf(hidden(texture(), {0, 0, 60, 80}), kLorry).seenOf(whole), 0.5, 0.1);
    EXPECT_NEAR(patchOf(hidden(texture(), {0, 0, 42, 80}), kLorry).seenOf(whole), 0.75, 0.1);
}

TEST(BoxPatch, IsSeenAsMuchWhetherItsLengthOrItsWidthIsLonger) {
    // Two parts across, of which something covers the most of one.
    const cv::Rect part(0, 0, 120, 39);
    cv::Mat turned;
    cv::rotate(texture(), turned, cv::ROTATE_90_CLOCKWISE);
    cv::Mat turned_hidden;
    cv::rotate(hidden(texture(), part), turned_hidden, cv::ROTATE_90_CLOCKWISE);
    const OrientedBox tall{{79 - kLorry.centre.y, kLorry.centre.x}, 12, 48, 0};
    const double across = patchOf(hidden(texture(), part), kLorry).seenOf(patchOf(texture(), kLorry));
    EXPECT_NEAR(across, 0.5, 0.1);
    EXPECT_NEAR(patchOf(turned_hidden, tall).seenOf(patchOf(turned, tall)), across, 1e-9);
}

TEST(BoxPatch, LearnsByShares) {
    BoxPatch patch = patchOf(texture(), kLorry);
    const BoxPatch start = patch;
    const BoxPatch other = patchOf(hidden(texture(), {0, 0, 120, 80}), kLorry);
    patch.learn(other, 0);
    EXPECT_NEAR(patch.correlation(start), 1, 1e-5);
    patch.learn(other, 0.25);
    EXPECT_GT(patch.correlation(start), patch.correlation(other));
    EXPECT_GT(patch.correlation(other), start.correlation(other));
    EXPECT_NEAR(patch.correlation(patch), 1, 1e-5) << "of length one again";
    patch.learn(other, 1);
    EXPECT_NEAR(patch.correlation(other), 1, 1e-5);
}

}  // namespace eyrie::box_patch_test
