#include "learning/classifiers/fast_ica.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "learning/classifiers/seeded_random.h"

namespace eyrie::fast_ica_test {
namespace {

/// Independent sources of variance 1: evenly distributed, Laplacian, two-valued.
Eigen::MatrixXd sources(int count) {
    SeededRandom random(5);
    Eigen::MatrixXd s(count, 3);
    for (int i = 0; i < count; ++i) {
        s(i, 0) = random.between(-std::sqrt(3.0), std::sqrt(3.0));
        const double u = random.uniform() - 0.5;
        s(i, 1) = -std::copysign(std::log(1 - 2 * std::abs(u)), u) / std::sqrt(2.0);
        s(i, 2) = random.below(2) == 0 ? -1 : 1;
    }
    return s;
}

}  // namespace

TEST(FastIca, separatesKnownSources) {
    const Eigen::MatrixXd s = sources(4000);
    Eigen::Matrix3d mixing;
    mixing << 1, 2, -0.5, 0.3, -1, 2, 1.5, 0.7, 0.4;
    Eigen::MatrixXd mixed = s * mixing.transpose();
    mixed.rowwise() += Eigen::RowVector3d(10, -3, 100);
    const Unmixing u = fastIca(mixed, 1);
    // Unmixing after mixing is a permutation with signs: one entry near ±1 per row and column, the others near 0.
    const Eigen::Matrix3d product = u.unmixing * mixing;
    Eigen::Matrix3d ones = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double value = std::abs(product(i, j));
            EXPECT_TRUE(value < 0.06 || std::abs(value - 1) < 0.06) << product;
            if (value > 0.5) ones(i, j) = 1;
        }
    }
    EXPECT_EQ(ones.colwise().sum(), Eigen::RowVector3d::Ones()) << product;
    EXPECT_EQ(ones.rowwise().sum(), Eigen::Vector3d::Ones()) << product;
    EXPECT_NEAR(u.log_volume, std::log(std::abs(u.unmixing.determinant())), 1e-9);
    EXPECT_NEAR(u.mean[2], 100, 0.2);
}

TEST(FastIca, componentsAreWhiteAndTheSameForTheSameSeed) {
    const Eigen::MatrixXd s = sources(500);
    const Unmixing u = fastIca(s, 3);
    const Eigen::MatrixXd components = (s.rowwise() - u.mean.transpose()) * u.unmixing.transpose();
    const Eigen::MatrixXd covariance = components.transpose() * components / 500;
    EXPECT_LT((covariance - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_EQ(u.unmixing, fastIca(s, 3).unmixing);
}

TEST(FastIca, standsDirectionsWithoutVariance) {
    Eigen::MatrixXd flat = Eigen::MatrixXd::Zero(50, 3);
    for (int i = 0; i < 50; ++i) flat(i, 0) = flat(i, 1) = i % 7;
    const Unmixing u = fastIca(flat, 1);
    EXPECT_TRUE(u.unmixing.allFinite());
    EXPECT_TRUE(std::isfinite(u.log_volume));
    EXPECT_TRUE(fastIca(Eigen::MatrixXd::Zero(2, 4), 1).unmixing.allFinite());
}

}  // namespace eyrie::fast_ica_test
