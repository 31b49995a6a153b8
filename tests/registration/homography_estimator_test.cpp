#include "registration/estimation/homography_estimator.h"

#include <gtest/gtest.h>

#include <random>

#include "registration/estimation/normal_equations.h"
#include "registration/flight.h"
#include "support/every_target.h"
#include "support/textured_ground.h"

namespace eyrie::homography_estimator_test {
namespace {

const cv::Size kSize(640, 480);

cv::Point2f mapped(const cv::Matx33d& m, cv::Point2f p) {
    const double w = m(2, 0) * p.x + m(2, 1) * p.y + m(2, 2);
    return {float((m(0, 0) * p.x + m(0, 1) * p.y + m(0, 2)) / w), float((m(1, 0) * p.x + m(1, 1) * p.y + m(1, 2)) / w)};
}

cv::Matx33d someMotion() {
    cv::Matx33d m = test::cameraMotion(kSize, 4.3, -2.8, 0.8, 1.006);
    m(2, 0) = 6e-6;
    m(2, 1) = -9e-6;
    return m;
}

/// Points over part of the picture, a share of them wrong by up to 12 px.
Correspondences points(const cv::Matx33d& m, cv::Rect2f area, int count, double noise, double wrong, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, noise);
    std::uniform_real_distribution<double> uniform(0, 1);
    Correspondences result;
    for (int i = 0; i < count; ++i) {
        const cv::Point2f from(area.x + float(uniform(random)) * area.width,
                               area.y + float(uniform(random)) * area.height);
        cv::Point2f to = mapped(m, from) + cv::Point2f(float(normal(random)), float(normal(random)));
        if (uniform(random) < wrong)
            to += cv::Point2f(float(24 * uniform(random) - 12), float(24 * uniform(random) - 12));
        result.add(from, to);
    }
    return result;
}

const cv::Rect2f kAll(0, 0, 639, 479);

}  // namespace

TEST(NormalEquations, everyInstructionSetMatchesDoublePrecision) {
    // Normalised coordinates; a count that leaves a remainder in every vector length.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const HomographyParameters h{1.01F, 0.02F, 0.03F, -0.015F, 0.99F, -0.02F, 0.004F, -0.003F};
    Correspondences p;
    for (int i = 0; i < 4099; ++i) {
        const cv::Point2f from(uniform(random), uniform(random));
        p.add(from, {from.x + 0.02F * uniform(random), from.y + 0.02F * uniform(random)},
              0.5F + 0.5F * uniform(random));
    }
    constexpr double kCutoff = 0.05;
    double plain[6] = {}, times_u0 = 0, times_v4 = 0, square1 = 0, right_x1 = 0, right_y2 = 0, right_p0 = 0, total = 0;
    std::vector<double> squares;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i) {
        const double x = p.from_x[i], y = p.from_y[i];
        const double w = double(h[6]) * x + double(h[7]) * y + 1;
        const double u = (double(h[0]) * x + double(h[1]) * y + double(h[2])) / w;
        const double v = (double(h[3]) * x + double(h[4]) * y + double(h[5])) / w;
        const double ex = u - double(p.to_x[i]), ey = v - double(p.to_y[i]);
        squares.push_back(ex * ex + ey * ey);
        const double q = std::max(0.0, 1 - squares.back() / (kCutoff * kCutoff));
        const double weight = q * q * double(p.weight[i]);
        const double k = weight / (w * w), r = weight / w;
        const double moments[6] = {x * x, x * y, x, y * y, y, 1};
        for (int m = 0; m < 6; ++m) plain[m] += k * moments[m];
        times_u0 += k * u * x * x;
        times_v4 += k * v * y;
        square1 += k * (u * u + v * v) * x * y;
        right_x1 += r * ex * y;
        right_y2 += r * ey;
        right_p0 += r * (u * ex + v * ey) * x;
        total += weight;
    }
    test::forEveryTarget([&](const std::string& name) {
        const NormalSums sums = sumNormalEquations(p, h, float(kCutoff));
        for (std::size_t m = 0; m < 6; ++m) EXPECT_NEAR(sums.plain[m], plain[m], 1e-3 * total / 10) << name;
        EXPECT_NEAR(sums.times_u[0], times_u0, 1e-3) << name;
        EXPECT_NEAR(sums.times_v[4], times_v4, 1e-3) << name;
        EXPECT_NEAR(sums.times_square[1], square1, 1e-3) << name;
        EXPECT_NEAR(sums.right_x[1], right_x1, 1e-4) << name;
        EXPECT_NEAR(sums.right_y[2], right_y2, 1e-4) << name;
        EXPECT_NEAR(sums.right_projective[0], right_p0, 1e-4) << name;
        EXPECT_NEAR(sums.weight, total, 1e-4 * total) << name;
        std::vector<float> found;
        squaredResiduals(p, h, found);
        for (std::size_t i = 0; i < squares.size(); ++i) EXPECT_NEAR(double(found[i]), squares[i], 1e-7) << name;
    });
}

TEST(HomographyEstimator, exactPointsGiveTheExactMap) {
    const HomographyEstimator estimator({}, kSize);
    const auto fit = estimator.refine(points(someMotion(), kAll, 300, 0, 0, 1), cv::Matx33d::eye());
    ASSERT_TRUE(fit);
    EXPECT_LT(test::gridError(fit->matrix, someMotion(), kSize), 1e-3);
    EXPECT_EQ(fit->inliers, 300);
    EXPECT_TRUE(estimator.trustworthy(*fit));
}

TEST(HomographyEstimator, noiseAveragesOut) {
    // 3,000 points with 0.1 px: eight numbers from 6,000 values leave 0.1 · √(8 / 6000) ≈ 0.004 px.
    const HomographyEstimator estimator({}, kSize);
    const auto fit = estimator.refine(points(someMotion(), kAll, 3000, 0.1, 0.3, 2), someMotion());
    ASSERT_TRUE(fit);
    EXPECT_LT(test::gridError(fit->matrix, someMotion(), kSize), 0.012);
    EXPECT_NEAR(fit->inlier_share, 0.7, 0.02);
    EXPECT_NEAR(fit->rms_px, 0.14, 0.03);
}

TEST(HomographyEstimator, searchNeedsNoStartAndSurvivesOutliers) {
    const HomographyEstimator estimator({}, kSize);
    const cv::Matx33d far = test::cameraMotion(kSize, 60, -35, 6, 1.05);
    for (const double wrong : {0.3, 0.6}) {
        const Correspondences p = points(far, kAll, 2000, 0.1, wrong, 3);
        const auto start = estimator.search(p, MotionModel::homography, 1);
        ASSERT_TRUE(start);
        const auto fit = estimator.refine(p, *start);
        ASSERT_TRUE(fit);
        EXPECT_LT(test::gridError(fit->matrix, far, kSize), 0.02) << wrong;
    }
    const auto similar = estimator.search(points(far, kAll, 200, 0.3, 0.5, 4), MotionModel::similarity, 1);
    ASSERT_TRUE(similar);
    EXPECT_LT(test::gridError(*similar, far, kSize), 2);
}

TEST(HomographyEstimator, movingCrowdDoesNotPullTheGround) {
    // A third of the points drives by 0.8 px.
    Correspondences p = points(someMotion(), kAll, 2000, 0.05, 0, 5);
    for (std::size_t i = 0; i < 700; ++i) p.to_x[i] += 0.8F;
    const auto fit = HomographyEstimator({}, kSize).refine(p, someMotion());
    ASSERT_TRUE(fit);
    EXPECT_LT(test::gridError(fit->matrix, someMotion(), kSize), 0.02);
}

TEST(HomographyEstimator, staysSaneWhereTextureIsInOnePart) {
    // Forty noisy points in a tenth of the picture: the far corner is extrapolated, but must not fly away.
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const auto fit = HomographyEstimator({}, kSize).refine(
            points(someMotion(), {20, 20, 200, 150}, 40, 0.1, 0, seed), cv::Matx33d::eye());
        ASSERT_TRUE(fit);
        EXPECT_LT(test::gridError(fit->matrix, someMotion(), kSize), 1.5) << seed;
        EXPECT_TRUE(plausibleMotion(fit->matrix, kSize));
    }
}

TEST(HomographyEstimator, aSharpTurnIsFoundWherePerspectiveMayBeAny) {
    // As features match: few, to half a pixel, most of them on something else.
    const cv::Matx33d turn = test::sharpTurn(kSize);
    const HomographyEstimator between_frames({}, kSize);
    const HomographyEstimator free = between_frames.anyPerspective();
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Correspondences p = points(turn, kAll, 200, 0.5, 0.6, seed);
        const auto errorOf = [&](const HomographyEstimator& estimator) {
            const auto start = estimator.search(p, MotionModel::homography, 3);
            const auto fit = start ? estimator.refine(p, *start, 2, 6) : std::nullopt;
            return fit ? test::gridError(fit->matrix, turn, kSize) : 1e3;
        };
        EXPECT_LT(errorOf(free), 2) << seed;
        EXPECT_GT(errorOf(between_frames), 5) << seed;
    }
}

TEST(HomographyEstimator, degenerateInputIsRefusedOrHarmless) {
    const HomographyEstimator estimator({}, kSize);
    EXPECT_FALSE(estimator.refine({}, cv::Matx33d::eye()));
    EXPECT_FALSE(estimator.search({}, MotionModel::homography, 1));
    EXPECT_FALSE(estimator.refine(points(someMotion(), kAll, 3, 0, 0, 1), cv::Matx33d::eye()));
    // All on one line, and all at one place.
    const auto line =
        estimator.refine(points(cv::Matx33d::eye(), {0, 100, 600, 0}, 100, 0.05, 0, 1), cv::Matx33d::eye());
    if (line) {
        EXPECT_TRUE(cv::checkRange(cv::Mat(line->matrix)));
    }
    EXPECT_FALSE(
        estimator.search(points(cv::Matx33d::eye(), {50, 50, 0, 0}, 100, 0, 0, 1), MotionModel::homography, 1));
    // Random pairs: nothing to trust.
    const auto nonsense = points(cv::Matx33d::eye(), kAll, 400, 80, 1, 9);
    const auto start = estimator.search(nonsense, MotionModel::homography, 1);
    if (start) {
        const auto fit = estimator.refine(nonsense, *start);
        EXPECT_TRUE(!fit || !estimator.trustworthy(*fit));
    }
}

TEST(HomographyEstimator, knowsWhatACameraCannotDo) {
    EXPECT_TRUE(plausibleMotion(someMotion(), kSize));
    EXPECT_FALSE(plausibleMotion({-1, 0, 639, 0, 1, 0, 0, 0, 1}, kSize));    // mirror
    EXPECT_FALSE(plausibleMotion({1, 0, 0, 0, 1, 0, -0.004, 0, 1}, kSize));  // horizon inside the picture
    EXPECT_FALSE(plausibleMotion({0.1, 0, 0, 0, 0.1, 0, 0, 0, 1}, kSize));   // ten times smaller
    EXPECT_FALSE(plausibleMotion({1, 0, 1000, 0, 1, 0, 0, 0, 1}, kSize));    // out of sight
}

TEST(HomographyEstimator, manyThatAgreeAreTrustedHoweverManyDoNot) {
    const HomographyEstimator estimator({}, kSize);
    const auto trusted = [&](int inliers, double share) {
        HomographyFit fit;
        fit.inliers = inliers;
        fit.inlier_share = share;
        return estimator.trustworthy(fit);
    };
    EXPECT_TRUE(trusted(1138, 1138.0 / 4842)) << "a turning camera at night";
    EXPECT_FALSE(trusted(100, 0.24)) << "so few may agree by chance";
    EXPECT_TRUE(trusted(100, 0.4));
    EXPECT_TRUE(trusted(2055, 0.11)) << "relief in a large picture";
    EXPECT_FALSE(trusted(999, 0.11));
    EXPECT_FALSE(trusted(1138, 0.05));
}

TEST(HomographyEstimator, aPictureFiveTimesLargerIsNoMotion) {
    const HomographyEstimator estimator({}, kSize);
    for (const double zoom : {5.0, 0.2}) {
        const cv::Matx33d m = test::cameraMotion(kSize, 0, 0, 0, zoom);
        EXPECT_FALSE(estimator.search(points(m, kAll, 100, 0, 0, 1), MotionModel::similarity, 1)) << zoom;
    }
    for (const double zoom : {3.5, 0.3}) {
        const cv::Matx33d m = test::cameraMotion(kSize, 0, 0, 0, zoom);
        const auto found = estimator.search(points(m, kAll, 100, 0, 0, 1), MotionModel::similarity, 1);
        ASSERT_TRUE(found) << zoom;
        EXPECT_LT(test::gridError(*found, m, kSize), 0.01);
    }
}

TEST(HomographyEstimator, aPlaneThatRecedesShrinksWithTheCubeOfItsDepth) {
    // At the right border the depth is three times that of the left: areas shrink by 27, more than 16.
    const auto receding = [](double depth) {
        return plausibleMotion({1, 0, 0, 0, 1, 0, (depth - 1) / 639, 0, 1}, kSize);
    };
    EXPECT_FALSE(receding(3));
    EXPECT_FALSE(receding(2.6));
    EXPECT_TRUE(receding(2.4));
    EXPECT_FALSE(plausibleMotion({3.9, 0, -2.9 * 319.5, 0, 3.9, -2.9 * 239.5, 0, 0, 1}, kSize))
        << "its border leaves the picture by more than its size";
    EXPECT_TRUE(plausibleMotion({2.9, 0, -1.9 * 319.5, 0, 2.9, -1.9 * 239.5, 0, 0, 1}, kSize));
    EXPECT_TRUE(plausibleMotion({0.26, 0, 0.74 * 319.5, 0, 0.26, 0.74 * 239.5, 0, 0, 1}, kSize));
    EXPECT_FALSE(plausibleMotion({0.24, 0, 0.76 * 319.5, 0, 0.24, 0.76 * 239.5, 0, 0, 1}, kSize));
    EXPECT_TRUE(plausibleMotion({1, 0, 639, 0, 1, -479, 0, 0, 1}, kSize));
    EXPECT_FALSE(plausibleMotion({1, 0, 641, 0, 1, 0, 0, 0, 1}, kSize));
    EXPECT_FALSE(plausibleMotion({1, 0, 0, 0, 1, -481, 0, 0, 1}, kSize));
}

TEST(HomographyEstimator, pointsWithoutAWeightSayNothing) {
    Correspondences p = points(someMotion(), kAll, 400, 0.02, 0, 6);
    for (std::size_t i = 0; i < 250; ++i) {
        p.to_x[i] += 30;
        p.weight[i] = 0;
    }
    const HomographyEstimator estimator({}, kSize);
    for (const MotionModel model : {MotionModel::similarity, MotionModel::homography}) {
        const auto start = estimator.search(p, model, 1);
        ASSERT_TRUE(start);
        const auto fit = estimator.refine(p, *start);
        ASSERT_TRUE(fit);
        EXPECT_LT(test::gridError(fit->matrix, someMotion(), kSize), 0.02);
        EXPECT_EQ(fit->inliers, 150);
        EXPECT_DOUBLE_EQ(fit->inlier_share, 1);
        EXPECT_NEAR(fit->sigma_px, 0.02, 0.004);
        EXPECT_NEAR(fit->rms_px, 0.02 * std::sqrt(2), 0.004);
        EXPECT_DOUBLE_EQ(fit->inlier_distance_px, 0.5) << "no less than that, however well points agree";
    }
}

}  // namespace eyrie::homography_estimator_test
