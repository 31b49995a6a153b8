#include "imaging/thresholds.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace eyrie::thresholds_test {
namespace {

const cv::Mat kTen = (cv::Mat_<float>(2, 5) << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10);

cv::Mat all(cv::Size size) {
    return {size, CV_8UC1, cv::Scalar(255)};
}

TEST(QuantileThreshold, KeepsTheBrightestShare) {
    EXPECT_FLOAT_EQ(*quantileThreshold(kTen, all(kTen.size()), 0.1), 10);
    EXPECT_FLOAT_EQ(*quantileThreshold(kTen, all(kTen.size()), 0.3), 8);
    EXPECT_FLOAT_EQ(*quantileThreshold(kTen, all(kTen.size()), 1.0), 1);
    EXPECT_FLOAT_EQ(*quantileThreshold(kTen, all(kTen.size()), 0.001), 10);  // at least one pixel
}

TEST(QuantileThreshold, LeavesPaddingOutOfTheShare) {
    cv::Mat mask = all(kTen.size());
    mask.row(0).setTo(0);  // 1 … 5 are padding
    EXPECT_FLOAT_EQ(*quantileThreshold(kTen, mask, 0.4), 9);
    mask.setTo(0);
    EXPECT_FALSE(quantileThreshold(kTen, mask, 0.4).has_value());
}

TEST(QuantileThreshold, DemandsAGradient) {
    const cv::Mat mostly_flat = (cv::Mat_<float>(1, 10) << 0, 0, 0, 0, 0, 0, 0, 0, 3, 5);
    EXPECT_FLOAT_EQ(*quantileThreshold(mostly_flat, all({10, 1}), 0.5), 3);
    EXPECT_FALSE(quantileThreshold(cv::Mat::zeros(4, 4, CV_32F), all({4, 4}), 0.5).has_value());
    EXPECT_FALSE(quantileThreshold(cv::Mat(), cv::Mat(), 0.5).has_value());
}

TEST(Binarise, TakesTheThresholdItselfAndNothingOutsideTheMask) {
    cv::Mat mask = all(kTen.size());
    mask.at<uchar>(1, 4) = 0;
    cv::Mat binary;
    binarise(kTen, mask, 8, binary);
    const cv::Mat expected = (cv::Mat_<uchar>(2, 5) << 0, 0, 0, 0, 0, 0, 0, 255, 255, 0);
    EXPECT_EQ(cv::countNonZero(binary != expected), 0);
}

}  // namespace
}  // namespace eyrie::thresholds_test
