#include "learning/classifiers/smo_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "learning/classifiers/seeded_random.h"

namespace eyrie::smo_solver_test {

TEST(SmoSolver, solvesTwoPointsAsOnPaper) {
    // max α₁ + α₂ − ½ Σ αᵢαⱼyᵢyⱼK with α₁ = α₂ = α: 2α − α²(1 − k), so that α = 1 / (1 − k) below C.
    const float k = 0.4F;
    cv::Mat1f kernel = (cv::Mat1f(2, 2) << 1, k, k, 1);
    const SmoSolution free = solveSmo(kernel, {1, -1}, 100);
    EXPECT_NEAR(free.alpha[0], 1 / (1 - k), 1e-3);
    EXPECT_NEAR(free.alpha[1], 1 / (1 - k), 1e-3);
    EXPECT_NEAR(free.bias, 0, 1e-3);
    const SmoSolution bounded = solveSmo(kernel, {1, -1}, 0.5);
    EXPECT_NEAR(bounded.alpha[0], 0.5, 1e-9);
}

TEST(SmoSolver, findsTheWidestStreetOnALine) {
    // Linear kernel on a line: −3, −1 against 2, 5. Support vectors are −1 and 2; the border lies at 0.5.
    const double x[4] = {-3, -1, 2, 5};
    cv::Mat1f kernel(4, 4);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) kernel(i, j) = static_cast<float>(x[i] * x[j]);
    }
    const std::vector<int> labels{-1, -1, 1, 1};
    const SmoSolution s = solveSmo(kernel, labels, 1000);
    double slope = 0;
    for (std::size_t i = 0; i < 4; ++i) slope += s.alpha[i] * labels[i] * x[i];
    EXPECT_NEAR(slope, 2.0 / 3, 2e-3);
    EXPECT_NEAR(-s.bias / slope, 0.5, 3e-3);
    EXPECT_NEAR(s.alpha[0], 0, 1e-9);
    EXPECT_NEAR(s.alpha[3], 0, 1e-9);
}

TEST(SmoSolver, meetsTheOptimalityConditionsOnARandomProblem) {
    SeededRandom random(1);
    constexpr int count = 80;
    cv::Mat1f x(count, 3);
    std::vector<int> labels;
    for (int i = 0; i < count; ++i) {
        labels.push_back(i % 2 == 0 ? 1 : -1);
        for (int d = 0; d < 3; ++d) x(i, d) = static_cast<float>(random.between(-1, 1) + 0.3 * labels.back());
    }
    cv::Mat1f kernel(count, count);
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < count; ++j)
            kernel(i, j) = static_cast<float>(std::exp(-cv::norm(x.row(i), x.row(j), cv::NORM_L2SQR)));
    }
    constexpr double c = 2;
    const SmoSolution s = solveSmo(kernel, labels, c);
    double balance = 0;
    for (int i = 0; i < count; ++i) {
        double decision = s.bias;
        for (int j = 0; j < count; ++j) decision += s.alpha[std::size_t(j)] * labels[std::size_t(j)] * kernel(i, j);
        const double margin = decision * labels[std::size_t(i)];
        const double alpha = s.alpha[std::size_t(i)];
        balance += alpha * labels[std::size_t(i)];
        if (alpha <= 0) {
            EXPECT_GE(margin, 1 - 5e-3);
        } else if (alpha >= c) {
            EXPECT_LE(margin, 1 + 5e-3);
        } else {
            EXPECT_NEAR(margin, 1, 5e-3);
        }
    }
    EXPECT_NEAR(balance, 0, 1e-9);
}

}  // namespace eyrie::smo_solver_test
