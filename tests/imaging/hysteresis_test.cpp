#include "imaging/hysteresis.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace eyrie::hysteresis_test {

TEST(Hysteresis, KeepsWeakPixelsThatTouchStrongOnes) {
    const cv::Mat values = (cv::Mat_<int>(3, 6) << 0, 40, 0, 0, 0, 40,  //
                            0, 0, 80, 0, 0, 0,                          //
                            0, 0, 0, 39, 0, 50);
    const cv::Mat expected = (cv::Mat_<uchar>(3, 6) << 0, 255, 0, 0, 0, 0,  //
                              0, 0, 255, 0, 0, 0,                           //
                              0, 0, 0, 0, 0, 0);
    EXPECT_EQ(cv::norm(hysteresis(values, 40, 80), expected, cv::NORM_INF), 0);
    cv::Mat real;
    values.convertTo(real, CV_32F);
    EXPECT_EQ(cv::norm(hysteresis(real, 40, 80), expected, cv::NORM_INF), 0);
    EXPECT_EQ(cv::countNonZero(hysteresis(values, 40, 81)), 0);
    EXPECT_TRUE(hysteresis(cv::Mat(), 1, 2).empty());
}

}  // namespace eyrie::hysteresis_test
