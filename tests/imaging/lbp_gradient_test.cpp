#include "imaging/lbp_gradient.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace eyrie::lbp_gradient_test {
namespace {

int clampedGray(const cv::Mat& gray, int x, int y) {
    return gray.at<uchar>(std::clamp(y, 0, gray.rows - 1), std::clamp(x, 0, gray.cols - 1));
}

/// Eq. 5.7–5.13 pixel by pixel, as one would write them down.
cv::Mat slowGradient(const cv::Mat& gray, const LbpGradientOptions& options) {
    cv::Mat sum = cv::Mat::zeros(gray.size(), CV_32F);
    for (int y = 0; y < gray.rows; ++y) {
        for (int x = 0; x < gray.cols; ++x) {
            double total = 0;
            for (const double radius : options.radii) {
                double g[8];
                int s[8];
                double mu = 0;
                int ones = 0;
                for (int p = 0; p < 8; ++p) {
                    double dx = radius * std::cos(2 * std::numbers::pi * p / 8);
                    double dy = -radius * std::sin(2 * std::numbers::pi * p / 8);
                    if (std::abs(dx - std::round(dx)) < 1e-6) dx = std::round(dx);
                    if (std::abs(dy - std::round(dy)) < 1e-6) dy = std::round(dy);
                    const int ix = x + static_cast<int>(std::floor(dx));
                    const int iy = y + static_cast<int>(std::floor(dy));
                    const float fx = static_cast<float>(dx - std::floor(dx));
                    const float fy = static_cast<float>(dy - std::floor(dy));
                    const auto at = [&](int column, int row) {
                        return static_cast<float>(clampedGray(gray, column, row));
                    };
                    const float top = at(ix, iy) + fx * (at(ix + 1, iy) - at(ix, iy));
                    const float bottom = at(ix, iy + 1) + fx * (at(ix + 1, iy + 1) - at(ix, iy + 1));
                    const float value = fx == 0 && fy == 0 ? at(ix, iy) : top + fy * (bottom - top);
                    const float difference = value - static_cast<float>(gray.at<uchar>(y, x));
                    s[p] = difference >= static_cast<float>(options.threshold) ? 1 : 0;
                    ones += s[p];
                    g[p] = value;
                    mu += value / 8.0;
                }
                int transitions = 0;
                for (int p = 0; p < 8; ++p) transitions += std::abs(s[p] - s[(p + 1) % 8]);
                if (transitions != 2 || ones == 1 || ones == 7) continue;
                double variance = 0;
                for (const double value : g) variance += (value - mu) * (value - mu) / 8;
                total += std::sqrt(variance);
            }
            sum.at<float>(y, x) = static_cast<float>(total);
        }
    }
    return sum;
}

cv::Mat noisyScene(int columns, int rows, std::uint64_t seed) {
    cv::RNG random(seed);
    cv::Mat gray(rows, columns, CV_8UC1);
    random.fill(gray, cv::RNG::NORMAL, 90, 6);
    cv::rectangle(gray, {columns / 4, rows / 4}, {columns / 2, rows / 2}, 180, cv::FILLED);
    cv::line(gray, {0, rows - 1}, {columns - 1, 0}, 20, 2);
    return gray;
}

TEST(LbpGradient, AcceptsExactlyTheUniformPatternsWithTwoToSixOnes) {
    // Neighbours from the right on, against the clock. Those on the diagonal are half the corner's value and a fifth of
    // each side's: 115 parts 128 of the corner alone from 106 of both sides.
    const cv::Point neighbours[8] = {{2, 1}, {2, 0}, {1, 0}, {0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}};
    LbpGradientOptions options;
    options.radii = {1};
    options.threshold = 115;
    int accepted = 0;
    for (unsigned pattern = 0; pattern < 256; ++pattern) {
        cv::Mat gray(3, 3, CV_8UC1, cv::Scalar(0));
        for (unsigned p = 0; p < 8; ++p) {
            if ((pattern >> p) & 1U) gray.at<uchar>(neighbours[p]) = 255;
        }
        cv::Mat gradient;
        lbpGradient(gray, options, gradient);
        const bool contour = gradient.at<float>(1, 1) > 0;
        int ones = 0;
        int transitions = 0;
        for (unsigned p = 0; p < 8; ++p) {
            const unsigned bit = (pattern >> p) & 1U;
            ones += static_cast<int>(bit);
            transitions += bit != ((pattern >> ((p + 1) % 8)) & 1U);
        }
        EXPECT_EQ(contour, transitions == 2 && ones >= 2 && ones <= 6) << pattern;
        accepted += contour;
    }
    EXPECT_EQ(accepted, 40);  // five classes of eight turns each
}

TEST(LbpGradient, EqualsTheSlowVersion) {
    for (const double threshold : {0.0, 3.0, 11.0}) {
        LbpGradientOptions options;
        options.radii = {1, 2, 3};
        options.threshold = threshold;
        const cv::Mat gray = noisyScene(61, 47, 7);
        cv::Mat fast;
        lbpGradient(gray, options, fast);
        const cv::Mat slow = slowGradient(gray, options);
        EXPECT_LT(cv::norm(fast, slow, cv::NORM_INF), 1e-4) << "threshold " << threshold;
        EXPECT_GT(cv::countNonZero(fast), 0);
    }
}

TEST(LbpGradient, TakesRadiiThatAreNotWhole) {
    LbpGradientOptions options;
    options.radii = {1.5};
    const cv::Mat gray = noisyScene(40, 33, 3);
    cv::Mat fast;
    lbpGradient(gray, options, fast);
    EXPECT_LT(cv::norm(fast, slowGradient(gray, options), cv::NORM_INF), 1e-4);
}

TEST(LbpGradient, IsZeroOnFlatGroundAndAnswersAtAStep) {
    cv::Mat gray(20, 20, CV_8UC1, cv::Scalar(77));
    cv::Mat gradient;
    LbpGradientOptions options;
    options.threshold = 0;
    lbpGradient(gray, options, gradient);
    EXPECT_EQ(cv::countNonZero(gradient), 0);

    gray.colRange(10, 20).setTo(177);
    options.threshold = 3;
    options.radii = {1};
    lbpGradient(gray, options, gradient);
    // Seen from the last dark column, three neighbours are bright (two of them by the interpolated 70.7 of 100).
    EXPECT_GT(gradient.at<float>(10, 9), 30);
    EXPECT_EQ(gradient.at<float>(10, 5), 0);
    EXPECT_EQ(gradient.at<float>(10, 15), 0);
}

TEST(LbpGradient, DoesNotDependOnBrightnessAndGrowsWithContrast) {
    const cv::Mat gray = noisyScene(48, 48, 11) / 3;
    LbpGradientOptions options;
    options.threshold = 0;
    cv::Mat first;
    cv::Mat brighter;
    cv::Mat stronger;
    lbpGradient(gray, options, first);
    lbpGradient(gray + 50, options, brighter);
    lbpGradient(gray * 2, options, stronger);
    EXPECT_LT(cv::norm(first, brighter, cv::NORM_INF), 1e-3);
    EXPECT_LT(cv::norm(first * 2, stronger, cv::NORM_INF), 1e-3);
}

TEST(LbpGradient, SuppressesNoiseThatAPlainGradientKeeps) {
    cv::RNG random(5);
    cv::Mat gray(200, 200, CV_8UC1);
    random.fill(gray, cv::RNG::NORMAL, 100, 2);
    LbpGradientOptions options;
    options.radii = {1};
    options.threshold = 3;
    cv::Mat gradient;
    lbpGradient(gray, options, gradient);
    // A share of 40 / 256 patterns would pass by chance; the threshold and the missing classes leave fewer.
    EXPECT_LT(cv::countNonZero(gradient), 0.35 * 200 * 200);
}

TEST(LbpGradient, TakesTinyAndEmptyImages) {
    cv::Mat gradient;
    lbpGradient(cv::Mat(1, 1, CV_8UC1, cv::Scalar(9)), {}, gradient);
    EXPECT_EQ(gradient.size(), cv::Size(1, 1));
    EXPECT_EQ(gradient.at<float>(0, 0), 0);
    lbpGradient(cv::Mat(2, 1, CV_8UC1, cv::Scalar(9)), {{1, 2, 5}, 0}, gradient);
    EXPECT_EQ(cv::countNonZero(gradient), 0);
    lbpGradient(cv::Mat(), {}, gradient);
    EXPECT_TRUE(gradient.empty());
}

}  // namespace
}  // namespace eyrie::lbp_gradient_test
