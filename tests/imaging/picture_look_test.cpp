#include "imaging/picture_look.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace eyrie::picture_look_test {
namespace {

cv::Mat ramp() {
    cv::Mat picture(64, 256, CV_8UC1);
    for (int x = 0; x < picture.cols; ++x) picture.col(x) = x;
    return picture;
}

int at(const cv::Mat& picture, int x) {
    return picture.at<uchar>(10, x);
}

}  // namespace

TEST(PictureLook, APlainOneLeavesThePictureAsItIs) {
    const cv::Mat picture = ramp();
    EXPECT_EQ(withLook(picture, {}).data, picture.data);
    EXPECT_TRUE(withLook(cv::Mat(), {.brightness = 0.5}).empty());
    const cv::Mat depth(4, 4, CV_16UC1, cv::Scalar(7));
    EXPECT_EQ(withLook(depth, {.brightness = 0.5}).data, depth.data);
}

TEST(PictureLook, BrightnessAddsAndContrastSteepensAroundTheMiddle) {
    const cv::Mat before = ramp();
    const cv::Mat brighter = withLook(before, {.brightness = 0.2});
    EXPECT_EQ(at(brighter, 100), 151);
    EXPECT_EQ(at(brighter, 250), 255);
    const cv::Mat steeper = withLook(before, {.contrast = 0.5});  // twice as steep
    EXPECT_NEAR(at(steeper, 137), 146, 1);
    EXPECT_NEAR(at(steeper, 117), 106, 1);
    EXPECT_EQ(at(steeper, 10), 0);
    const cv::Mat flat = withLook(before, {.contrast = -1});
    EXPECT_EQ(at(flat, 0), at(flat, 255));
    EXPECT_EQ(at(before, 100), 100);  // what it is made of stays
    EXPECT_EQ(at(withLook(before, {.brightness = 7}), 0), 255);
}

TEST(PictureLook, EveningOutShowsWhatLiesInTheDark) {
    cv::Mat picture(240, 240, CV_8UC1, cv::Scalar(20));
    picture.colRange(120, 240) = 200;
    cv::RNG random(3);
    cv::Mat noise(picture.size(), CV_8UC1);
    random.fill(noise, cv::RNG::UNIFORM, 0, 6);
    picture += noise;
    const auto spread = [](const cv::Mat& each) {
        cv::Scalar mean, deviation;
        cv::meanStdDev(each.colRange(20, 80), mean, deviation);
        return deviation[0];
    };
    EXPECT_GT(spread(withLook(picture, {.even = true})), 1.5 * spread(picture));
}

TEST(PictureLook, EveningOutDoesNotMakeAPictureOfNoise) {
    // Of six grey levels each holds a sixth of a tile; no level gets more than 2.5 and its part of what is cut off, 1,
    // of 256 shares, so that five steps become some 16.
    cv::Mat road(240, 240, CV_8UC1);
    cv::RNG(4).fill(road, cv::RNG::UNIFORM, 100, 106);
    double darkest = 0, brightest = 0;
    cv::minMaxLoc(withLook(road, {.even = true})(cv::Rect(100, 100, 40, 40)), &darkest, &brightest);
    EXPECT_NEAR(brightest - darkest, 16, 3);
}

TEST(PictureLook, ColoursKeepTheirHue) {
    const cv::Mat picture(32, 32, CV_8UC3, cv::Scalar(60, 90, 120));
    const cv::Vec3b after = withLook(picture, {.brightness = 0.1}).at<cv::Vec3b>(5, 5);
    EXPECT_NEAR(after[2] - after[0], 60, 3);
    EXPECT_NEAR(after[1] - after[0], 30, 3);
    EXPECT_NEAR(after[1], 90 + 25, 4);
}

}  // namespace eyrie::picture_look_test
