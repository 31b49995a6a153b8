#include "imaging/picture_darkness.h"

#include <gtest/gtest.h>

#include <cmath>

namespace eyrie::picture_darkness_test {
namespace {

double darknessOfGrey(int grey) {
    return darknessOf(cv::Mat(90, 160, CV_8UC1, cv::Scalar(grey)));
}

}  // namespace

TEST(PictureDarkness, GrowsFromStreetLightToNight) {
    EXPECT_EQ(darknessOfGrey(120), 0);
    EXPECT_EQ(darknessOfGrey(60), 0);
    EXPECT_NEAR(darknessOfGrey(46), 0.4, 1e-12);
    EXPECT_NEAR(darknessOfGrey(32), 0.8, 1e-12);
    EXPECT_EQ(darknessOfGrey(25), 1);
    EXPECT_EQ(darknessOfGrey(0), 1);
}

TEST(PictureDarkness, LampsMakeNoDayAndShadowsNoNight) {
    cv::Mat night(540, 960, CV_8UC1, cv::Scalar(20));
    night.colRange(0, 400).setTo(255);
    EXPECT_EQ(darknessOf(night), 1);
    cv::Mat day(540, 960, CV_8UC1, cv::Scalar(110));
    day.rowRange(0, 200).setTo(5);
    EXPECT_EQ(darknessOf(day), 0);
}

TEST(PictureDarkness, NothingIsNotDark) {
    EXPECT_EQ(darknessOf({}), 0);
    EXPECT_EQ(darknessOf(cv::Mat(1, 1, CV_8UC1, cv::Scalar(0))), 1);
}

}  // namespace eyrie::picture_darkness_test
