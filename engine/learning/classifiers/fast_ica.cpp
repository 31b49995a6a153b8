#include "learning/classifiers/fast_ica.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "learning/classifiers/seeded_random.h"

namespace eyrie {
namespace {

constexpr int kMostIterations = 100;
constexpr double kSettled = 1e-5;

/// The nearest orthogonal matrix: (W Wᵀ)^(−1/2) W.
Eigen::MatrixXd orthogonalised(const Eigen::MatrixXd& w) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(w * w.transpose());
    const Eigen::VectorXd scale = solver.eigenvalues().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
    return solver.eigenvectors() * scale.asDiagonal() * solver.eigenvectors().transpose() * w;
}

}  // namespace

Unmixing fastIca(const Eigen::MatrixXd& samples, std::uint64_t seed, double least_variance) {
    const Eigen::Index dimension = samples.cols();
    const auto count = static_cast<double>(samples.rows());
    Unmixing result;
    result.mean = samples.colwise().mean().transpose();
    const Eigen::MatrixXd centred = samples.rowwise() - result.mean.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred.transpose() * centred / count);
    const double mean_variance = std::max(solver.eigenvalues().mean(), 1e-12);
    const Eigen::VectorXd variances = solver.eigenvalues().cwiseMax(least_variance * mean_variance);
    const Eigen::MatrixXd whitening =
        variances.cwiseSqrt().cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
    const Eigen::MatrixXd white = centred * whitening.transpose();

    SeededRandom random(seed);
    Eigen::MatrixXd w(dimension, dimension);
    for (Eigen::Index i = 0; i < dimension; ++i) {
        for (Eigen::Index j = 0; j < dimension; ++j) w(i, j) = random.between(-1, 1);
    }
    w = orthogonalised(w);
    for (int step = 0; step < kMostIterations; ++step) {
        const Eigen::MatrixXd g = (white * w.transpose()).array().tanh();  // samples × components
        const Eigen::VectorXd slope = (1 - g.array().square()).colwise().mean().transpose();
        const Eigen::MatrixXd next = orthogonalised(g.transpose() * white / count - slope.asDiagonal() * w);
        const double change = ((next * w.transpose()).diagonal().cwiseAbs().array() - 1).abs().maxCoeff();
        w = next;
        if (change < kSettled) break;
    }
    result.unmixing = w * whitening;
    // W is orthogonal, so that only the whitening changes volumes.
    result.log_volume = -0.5 * variances.array().log().sum();
    return result;
}

}  // namespace eyrie
