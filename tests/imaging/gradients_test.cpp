#include "imaging/gradients.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace eyrie::gradients_test {
namespace {

cv::Mat ramp(int slope_x, int slope_y) {
    cv::Mat gray(15, 15, CV_8UC1);
    for (int y = 0; y < gray.rows; ++y) {
        for (int x = 0; x < gray.cols; ++x) gray.at<uchar>(y, x) = static_cast<uchar>(10 + slope_x * x + slope_y * y);
    }
    return gray;
}

TEST(SimpleGradient, IsTheDifferenceToTheRightAndBelow) {
    cv::Mat gradient;
    simpleGradient((cv::Mat_<uchar>(2, 3) << 10, 13, 13, 14, 10, 200), gradient);
    EXPECT_FLOAT_EQ(gradient.at<float>(0, 0), 5);    // 3 right, 4 below
    EXPECT_FLOAT_EQ(gradient.at<float>(0, 1), 3);    // 0 right, −3 below
    EXPECT_FLOAT_EQ(gradient.at<float>(0, 2), 187);  // border repeated: below only
    EXPECT_FLOAT_EQ(gradient.at<float>(1, 1), 190);
    EXPECT_FLOAT_EQ(gradient.at<float>(1, 2), 0);
}

TEST(CannyGradient, OfARampIsItsSlope) {
    cv::Mat gradient;
    cannyGradient(ramp(3, 4), 0.5, gradient);
    EXPECT_NEAR(gradient.at<float>(7, 7), 5, 1e-3);
    cannyGradient(ramp(6, 8), 2.0, gradient);
    EXPECT_NEAR(gradient.at<float>(7, 7), 10, 1e-3);
}

TEST(CannyGradient, OfADotIsTheSlopeOfAGaussian) {
    // Variance .5: g = 1, .3679, .0183, .0001, their sum over both sides 1.7726; i · g falls by .8845 a grey level.
    cv::Mat dot(15, 15, CV_8UC1, cv::Scalar(0));
    dot.at<uchar>(7, 7) = 100;
    cv::Mat gradient;
    cannyGradient(dot, 0.5, gradient);
    EXPECT_NEAR(gradient.at<float>(7, 7), 0, 1e-4);
    EXPECT_NEAR(gradient.at<float>(7, 8), 23.463, 1e-2);  // 100 · (.3679 / .8845) · (1 / 1.7726)
    EXPECT_NEAR(gradient.at<float>(8, 8), 12.207, 1e-2);  // the same along both axes, a row further off
    EXPECT_NEAR(gradient.at<float>(9, 7), 2.336, 1e-2);
    cannyGradient(dot, 2, gradient);
    EXPECT_NEAR(gradient.at<float>(7, 8), 3.103, 1e-2);
}

TEST(CannyGradient, SmoothsNoise) {
    cv::RNG random(1);
    cv::Mat gray(100, 100, CV_8UC1);
    random.fill(gray, cv::RNG::NORMAL, 100, 5);
    cv::Mat plain;
    cv::Mat smooth;
    simpleGradient(gray, plain);
    cannyGradient(gray, 2.0, smooth);
    EXPECT_LT(cv::mean(smooth)[0], 0.5 * cv::mean(plain)[0]);
}

TEST(CannyGradient, SeesBothSidesAlikeAndNeedsAWidth) {
    cv::RNG random(2);
    cv::Mat gray(40, 50, CV_8UC1);
    random.fill(gray, cv::RNG::UNIFORM, 0, 256);
    for (const double variance : {0.5, 3.0}) {
        cv::Mat gradient;
        cannyGradient(gray, variance, gradient);
        for (const int axis : {0, 1}) {
            cv::Mat flipped;
            cv::flip(gray, flipped, axis);
            cv::Mat of_flipped;
            cannyGradient(flipped, variance, of_flipped);
            cv::flip(of_flipped, of_flipped, axis);
            EXPECT_LT(cv::norm(gradient, of_flipped, cv::NORM_INF), 1e-2) << variance;
        }
    }
    cv::Mat unused;
    EXPECT_THROW(cannyGradient(gray, 0, unused), cv::Exception);
}

TEST(MorphologicalGradient, IsMaximumMinusMinimumOfTheNeighbourhood) {
    cv::Mat gray(7, 7, CV_8UC1, cv::Scalar(50));
    gray.at<uchar>(3, 3) = 90;
    cv::Mat gradient;
    morphologicalGradient(gray, gradient);
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 7; ++x) {
            const bool near = std::abs(x - 3) <= 1 && std::abs(y - 3) <= 1;
            EXPECT_FLOAT_EQ(gradient.at<float>(y, x), near ? 40.0F : 0.0F);
        }
    }
}

TEST(Gradients, TakeOnePixelAndNone) {
    for (const cv::Mat& gray : {cv::Mat(1, 1, CV_8UC1, cv::Scalar(5)), cv::Mat()}) {
        cv::Mat a;
        cv::Mat b;
        cv::Mat c;
        simpleGradient(gray, a);
        cannyGradient(gray, 0.5, b);
        morphologicalGradient(gray, c);
        for (const cv::Mat& gradient : {a, b, c}) {
            EXPECT_EQ(gradient.size(), gray.size());
            EXPECT_EQ(gradient.empty() ? 0 : cv::countNonZero(gradient), 0);
        }
    }
}

}  // namespace
}  // namespace eyrie::gradients_test
