#include "motion/vectors/background_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace eyrie::background_noise_test {
namespace {

TEST(BackgroundNoise, FindsTheDeviationDespiteMovingObjects) {
    std::mt19937 random(3);
    std::normal_distribution<double> error(0, 0.05);
    BackgroundNoise noise(8);
    for (int i = 0; i < 4000; ++i) noise.add(8, std::hypot(error(random), error(random)));
    for (int i = 0; i < 400; ++i) noise.add(8, 2.0);  // a tenth of the corners moves
    noise.finish();
    EXPECT_NEAR(noise.sigma(8), 0.05, 0.008);
}

TEST(BackgroundNoise, RareBaselinesTakeTheDisplacementOfAll) {
    BackgroundNoise noise(10);
    for (int i = 0; i < 1000; ++i) noise.add(10, 0.02);  // 0.2 px over ten frames
    noise.add(5, 7.0);
    noise.finish();
    EXPECT_NEAR(noise.sigma(10), 0.02 / 1.17741, 1e-5);
    EXPECT_NEAR(noise.sigma(5), 0.04 / 1.17741, 1e-5);
}

TEST(BackgroundNoise, IsZeroWithoutCorners) {
    BackgroundNoise noise(4);
    noise.finish();
    for (int n = -1; n < 7; ++n) EXPECT_EQ(noise.sigma(n), 0);
}

}  // namespace
}  // namespace eyrie::background_noise_test
