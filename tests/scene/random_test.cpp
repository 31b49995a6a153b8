#include "scene/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/painting/polygon_scan.h"
#include "scene/portable_math.h"

namespace eyrie::random_test {

TEST(Random, isTheSameEverywhere) {
    // The first outputs of the prescribed generator for seed 1 are 1791095845 and 4282876139.
    Random random(1);
    EXPECT_EQ(random.uniform(), 1791095845.0 / 4294967296.0);
    EXPECT_EQ(random.uniform(), 4282876139.0 / 4294967296.0);
}

TEST(Random, normalNumbersHaveMeanZeroAndDeviationOne) {
    Random random(3);
    double sum = 0;
    double squares = 0;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
        const double value = random.normal();
        sum += value;
        squares += value * value;
    }
    // Four standard errors.
    EXPECT_NEAR(sum / count, 0, 4 / std::sqrt(count));
    EXPECT_NEAR(squares / count, 1, 4 * std::sqrt(2.0 / count));
}

TEST(Noise, isContinuousAndWithinOne) {
    double largest_step = 0;
    for (double x = -20; x < 20; x += 0.01) {
        const float value = fractalNoise(x, 3.3, 5, 4);
        EXPECT_LE(std::abs(value), 1);
        largest_step = std::max(largest_step, static_cast<double>(std::abs(value - fractalNoise(x + 0.01, 3.3, 5, 4))));
    }
    EXPECT_LT(largest_step, 0.08);
}

TEST(Noise, blendsTheValuesOfTheFourCorners) {
    const auto corner = [](std::uint32_t x, std::uint32_t y) {
        return static_cast<double>(hashOf(x, y, 9) >> 8U) * 2 / 16777215 - 1;
    };
    EXPECT_NEAR(valueNoise(3, 5, 9), corner(3, 5), 1e-6);
    EXPECT_NEAR(valueNoise(3.5, 5, 9), (corner(3, 5) + corner(4, 5)) / 2, 1e-6);
    // A quarter of the way counts 3/16 less 1/32.
    EXPECT_NEAR(valueNoise(3.25, 5, 9), corner(3, 5) * 0.84375 + corner(4, 5) * 0.15625, 1e-6);
    EXPECT_NEAR(valueNoise(3, 5.25, 9), corner(3, 5) * 0.84375 + corner(3, 6) * 0.15625, 1e-6);
    EXPECT_NEAR(valueNoise(3.5, 5.5, 9), (corner(3, 5) + corner(4, 5) + corner(3, 6) + corner(4, 6)) / 4, 1e-6);
}

TEST(Noise, octavesAreTurnedFinerAndWeaker) {
    EXPECT_EQ(fractalNoise(3.3, 5.7, 9, 1, 0.5F), valueNoise(3.3, 5.7, 9));
    const double second = valueNoise(2 * (0.8 * 3.3 - 0.6 * 5.7), 2 * (0.6 * 3.3 + 0.8 * 5.7), 9 + 131);
    EXPECT_NEAR(fractalNoise(3.3, 5.7, 9, 2, 0.5F), (valueNoise(3.3, 5.7, 9) + 0.5 * second) / 1.5, 1e-6);
}

TEST(PortableMath, agreesWithTheStandardLibrary) {
    for (double x = -30; x < 30; x += 0.0137) {
        EXPECT_NEAR(portable::sine(x), std::sin(x), 1e-13) << x;
        EXPECT_NEAR(portable::cosine(x), std::cos(x), 1e-13) << x;
        EXPECT_NEAR(portable::exponential(x) / std::exp(x), 1, 1e-13) << x;
        EXPECT_NEAR(portable::arcTangent(std::sin(x) * 3, std::cos(x) * 3), std::atan2(std::sin(x), std::cos(x)), 1e-12)
            << x;
    }
    EXPECT_EQ(portable::arcTangent(0, 0), 0);
    EXPECT_NEAR(portable::arcTangent(0, -1), std::atan2(0, -1), 1e-13);
}

TEST(PolygonScan, coversExactlyItsArea) {
    // A turned square of side 7 whose corners lie off the grid, and a concave outline.
    const std::vector<std::vector<cv::Point2d>> outlines{{{10.3, 4.1}, {15.2, 9.1}, {10.2, 14.0}, {5.3, 9.0}},
                                                         {{3, 3}, {17, 3}, {17, 17}, {10, 8.25}, {3, 17}}};
    const double areas[2] = {49.01, 14 * 14 - 14 * 8.75 / 2};
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        double sum = 0;
        scanPolygon(outlines[i], {0, 0, 30, 30}, [&](int, int begin, int end, const float* coverage) {
            for (int x = begin; x < end; ++x) {
                EXPECT_GE(coverage[x - begin], 0);
                EXPECT_LE(coverage[x - begin], 1.0001);
                sum += coverage[x - begin];
            }
        });
        EXPECT_NEAR(sum, areas[i], 0.3) << i;
    }
}

TEST(PolygonScan, isClippedToItsBounds) {
    double sum = 0;
    scanPolygon({{-100, -100}, {100, -100}, {100, 100}, {-100, 100}}, {2, 3, 5, 4},
                [&](int y, int begin, int end, const float* c) {
                    EXPECT_GE(y, 3);
                    EXPECT_LT(y, 7);
                    EXPECT_EQ(begin, 2);
                    EXPECT_EQ(end, 7);
                    for (int x = begin; x < end; ++x) sum += c[x - begin];
                });
    EXPECT_NEAR(sum, 20, 1e-4);
}

}  // namespace eyrie::random_test
