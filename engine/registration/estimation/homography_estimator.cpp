#include "registration/estimation/homography_estimator.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <opencv2/core.hpp>
#include <random>

#include "registration/estimation/normal_equations.h"
#include "registration/pictures/scaled_to_one.h"

namespace eyrie {
namespace {

// Tighter than the 4.685 that is best for one normal distribution: vehicles a few deviations off must not count.
constexpr double kTukey = 3.0;
// Perspective changes between neighbouring frames bend the borders of the picture by no more than a few px.
constexpr double kProjectiveDeviation = 0.004;
constexpr double kAnyProjectiveDeviation = 0.3;
constexpr int kSearchPoints = 512;
constexpr int kSearchRounds = 300;
constexpr int kThoroughSearchRounds = 4000;  // where one match in four is right

using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

HomographyParameters parametersOf(const cv::Matx33d& m) {
    HomographyParameters h{};
    for (int i = 0; i < 8; ++i) h[std::size_t(i)] = static_cast<float>(m.val[i] / m.val[8]);
    return h;
}

cv::Matx33d matrixOf(const HomographyParameters& h) {
    return {h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1};
}

Matrix8 matrixFrom(const NormalSums& s) {
    Eigen::Matrix3d plain;
    plain << s.plain[0], s.plain[1], s.plain[2], s.plain[1], s.plain[3], s.plain[4], s.plain[2], s.plain[4], s.plain[5];
    const auto mixed = [](const std::array<double, 5>& t) {
        Eigen::Matrix<double, 3, 2> m;
        m << t[0], t[1], t[1], t[3], t[2], t[4];
        return m;
    };
    Matrix8 a = Matrix8::Zero();
    a.block<3, 3>(0, 0) = plain;
    a.block<3, 3>(3, 3) = plain;
    a.block<3, 2>(0, 6) = -mixed(s.times_u);
    a.block<3, 2>(3, 6) = -mixed(s.times_v);
    a.block<2, 3>(6, 0) = a.block<3, 2>(0, 6).transpose();
    a.block<2, 3>(6, 3) = a.block<3, 2>(3, 6).transpose();
    a(6, 6) = s.times_square[0];
    a(6, 7) = s.times_square[1];
    a(7, 6) = s.times_square[1];
    a(7, 7) = s.times_square[2];
    return a;
}

Vector8 rightSideFrom(const NormalSums& s) {
    Vector8 b;
    b << s.right_x[0], s.right_x[1], s.right_x[2], s.right_y[0], s.right_y[1], s.right_y[2], -s.right_projective[0],
        -s.right_projective[1];
    return b;
}

/// Deviation in one direction of two-dimensional residuals, from their weighted 40 % quantile: noisy corners, which
/// weigh little, do not widen it, and neither do up to 60 % outliers. To 3 %: counted in bins of 1/16 octave.
double robustSigma(const std::vector<float>& squares, const std::vector<float>& weights, std::vector<double>& bins) {
    constexpr int kMantissaBits = 19;  // dropped ones
    bins.assign(std::size_t(1) << (31 - kMantissaBits), 0.0);
    double total = 0;
    for (std::size_t i = 0; i < squares.size(); ++i) {
        bins[std::bit_cast<std::uint32_t>(std::max(squares[i], 0.0F)) >> kMantissaBits] += double(weights[i]);
        total += double(weights[i]);
    }
    if (!(total > 0)) return 0;
    double below = 0;
    std::size_t bin = 0;
    while (bin + 1 < bins.size() && below + bins[bin] < 0.4 * total) below += bins[bin++];
    const auto middle = static_cast<std::uint32_t>((bin << kMantissaBits) + (std::size_t(1) << (kMantissaBits - 1)));
    constexpr double kQuantileOfRayleigh = 1.0108;
    return std::sqrt(double(std::bit_cast<float>(middle))) / kQuantileOfRayleigh;
}

/// One reweighted Gauss–Newton step in normalised coordinates; returns the largest change of a parameter, or nothing
/// when no point lies within the cutoff.
/// `projective_deviation` holds the two projective numbers where the points do not (few points, or all in one part of
/// the picture).
std::optional<double> improve(const Correspondences& points, HomographyParameters& h, double cutoff, double deviation,
                              double projective_deviation) {
    const NormalSums sums = sumNormalEquations(points, h, static_cast<float>(cutoff));
    if (!(sums.weight > 0)) return std::nullopt;
    Matrix8 a = matrixFrom(sums);
    Vector8 b = rightSideFrom(sums);
    const double hold = deviation * deviation / (projective_deviation * projective_deviation);
    a(6, 6) += hold;
    a(7, 7) += hold;
    b[6] += hold * double(h[6]);
    b[7] += hold * double(h[7]);
    // A trace of damping keeps a degenerate system solvable; it then stays where it started.
    a.diagonal().array() += 1e-9 * sums.weight;
    const Vector8 change = a.ldlt().solve(b);
    if (!change.allFinite()) return std::nullopt;
    for (int i = 0; i < 8; ++i) h[std::size_t(i)] -= static_cast<float>(change[i]);
    return change.cwiseAbs().maxCoeff();
}

/// What a hypothesis costs: squared residuals, those beyond the tolerance as much as it.
struct Cost {
    double sum = 0;
    int agreeing = 0;
};

Cost costOf(const Correspondences& points, const HomographyParameters& h, float tolerance,
            std::vector<float>& squares) {
    squaredResiduals(points, h, squares);
    Cost cost;
    for (const float square : squares) {
        const bool agrees = square < tolerance;
        cost.agreeing += agrees;
        cost.sum += double(agrees ? square : tolerance);
    }
    return cost;
}

/// The similarity through two pairs; false when they are too close.
bool similarityThrough(const Correspondences& p, const std::size_t* at, HomographyParameters& h) {
    const std::complex<float> from(p.from_x[at[1]] - p.from_x[at[0]], p.from_y[at[1]] - p.from_y[at[0]]);
    const std::complex<float> to(p.to_x[at[1]] - p.to_x[at[0]], p.to_y[at[1]] - p.to_y[at[0]]);
    if (std::norm(from) < 0.01F) return false;
    const std::complex<float> s = to / from;
    if (std::norm(s) < 0.0625F || std::norm(s) > 16) return false;
    const float tx = p.to_x[at[0]] - (s.real() * p.from_x[at[0]] - s.imag() * p.from_y[at[0]]);
    const float ty = p.to_y[at[0]] - (s.imag() * p.from_x[at[0]] + s.real() * p.from_y[at[0]]);
    h = {s.real(), -s.imag(), tx, s.imag(), s.real(), ty, 0, 0};
    return true;
}

/// The homography through four pairs; false when three lie on a line.
bool homographyThrough(const Correspondences& p, const std::size_t* at, HomographyParameters& h) {
    Matrix8 a;
    Vector8 b;
    for (int k = 0; k < 4; ++k) {
        const double x = p.from_x[at[k]];
        const double y = p.from_y[at[k]];
        const double u = p.to_x[at[k]];
        const double v = p.to_y[at[k]];
        a.row(2 * k) << x, y, 1, 0, 0, 0, -u * x, -u * y;
        a.row(2 * k + 1) << 0, 0, 0, x, y, 1, -v * x, -v * y;
        b[2 * k] = u;
        b[2 * k + 1] = v;
    }
    const Vector8 solution = a.partialPivLu().solve(b);
    if (!(solution.cwiseAbs().maxCoeff() < 8) || !(std::abs(solution[6]) + std::abs(solution[7]) < 0.5)) return false;
    for (int i = 0; i < 8; ++i) h[std::size_t(i)] = static_cast<float>(solution[i]);
    return true;
}

}  // namespace

void HomographyOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::registration);
    declare.real(
        "registration.inlier_distance", inlier_distance, 0.1, 10,
        {"px",
         "Largest residual with which a corner counts as background. The true limit is five times the measured "
         "deviation where that is less.",
         ""});
    declare.integer("registration.min_inliers", min_inliers, 6, 10000,
                    {"", "Fewer agreeing corners than this, and a frame counts as not registered.", ""});
    declare.real("registration.min_inlier_share", min_inlier_share, 0.05, 0.95,
                 {"",
                  "A smaller share of agreeing corners than this, and a frame counts as not registered; of less than "
                  "300 agreeing corners at least 0.3, of 1000 and more half of it.",
                  ""});
}

HomographyEstimator::HomographyEstimator(const HomographyOptions& options, cv::Size image)
    : options_(options),
      centre_x_((image.width - 1) / 2.0),
      centre_y_((image.height - 1) / 2.0),
      per_px_(2.0 / std::max({image.width, image.height, 1})),
      projective_deviation_(kProjectiveDeviation),
      search_rounds_(kSearchRounds) {}

HomographyEstimator HomographyEstimator::anyPerspective() const {
    HomographyEstimator free = *this;
    free.projective_deviation_ = kAnyProjectiveDeviation;
    free.search_rounds_ = kThoroughSearchRounds;
    return free;
}

cv::Matx33d HomographyEstimator::normalisedFromPx() const {
    return {per_px_, 0, -per_px_ * centre_x_, 0, per_px_, -per_px_ * centre_y_, 0, 0, 1};
}

Correspondences HomographyEstimator::normalised(const Correspondences& points) const {
    Correspondences result = points;
    const auto shift = [this](std::vector<float>& column, double centre) {
        const auto c = static_cast<float>(centre);
        const auto s = static_cast<float>(per_px_);
        for (float& value : column) value = (value - c) * s;
    };
    shift(result.from_x, centre_x_);
    shift(result.from_y, centre_y_);
    shift(result.to_x, centre_x_);
    shift(result.to_y, centre_y_);
    return result;
}

std::optional<HomographyFit> HomographyEstimator::refine(const Correspondences& points, const cv::Matx33d& start,
                                                         double coarseness, double first_cutoff_px) const {
    const double farthest_px = options_.inlier_distance * coarseness;
    // Residuals below this are interpolation, not motion; the cutoff need not follow them down.
    constexpr double kSmallestCutoffPx = 0.15;
    constexpr int kMostSteps = 12;
    constexpr double kConvergedPx = 1e-3;
    if (points.size() < 4) return std::nullopt;
    const Correspondences p = normalised(points);
    const cv::Matx33d to_normalised = normalisedFromPx();
    HomographyParameters h = parametersOf(scaledToOne(to_normalised * start * to_normalised.inv()));
    std::vector<float> squares;
    std::vector<double> scratch;
    const double converged = kConvergedPx * per_px_;
    double sigma = 0;
    double cutoff = first_cutoff_px * per_px_;
    for (int step = 0; step < kMostSteps; ++step) {
        squaredResiduals(p, h, squares);
        sigma = robustSigma(squares, p.weight, scratch);
        // Never wider again: a wider cutoff lets a crowd of vehicles in, which widens it further.
        cutoff = std::min(cutoff, std::max(kTukey * sigma, kSmallestCutoffPx * coarseness * per_px_));
        if (step > 2) cutoff = std::min(cutoff, 3 * farthest_px * per_px_);
        const auto change = improve(p, h, cutoff, std::max(sigma, 0.02 * per_px_), projective_deviation_);
        if (!change) return std::nullopt;
        if (step > 1 && *change < converged) break;
    }
    HomographyFit fit;
    fit.matrix = scaledToOne(to_normalised.inv() * matrixOf(h) * to_normalised);
    squaredResiduals(p, h, squares);
    sigma = robustSigma(squares, p.weight, scratch);
    fit.sigma_px = sigma / per_px_;
    fit.inlier_distance_px = std::clamp(5 * fit.sigma_px, std::min(0.5 * coarseness, farthest_px), farthest_px);
    const auto limit = static_cast<float>(fit.inlier_distance_px * per_px_ * fit.inlier_distance_px * per_px_);
    double sum = 0;
    int weighty = 0;
    for (std::size_t i = 0; i < squares.size(); ++i) {
        if (!(p.weight[i] > 0)) continue;
        ++weighty;
        if (!(squares[i] <= limit)) continue;
        ++fit.inliers;
        sum += double(squares[i]);
    }
    fit.inlier_share = weighty > 0 ? double(fit.inliers) / weighty : 0;
    fit.rms_px = fit.inliers > 0 ? std::sqrt(sum / fit.inliers) / per_px_ : 0;
    return fit;
}

std::optional<cv::Matx33d> HomographyEstimator::search(const Correspondences& points, MotionModel model,
                                                       double tolerance_px) const {
    const std::size_t sample_size = model == MotionModel::similarity ? 2 : 4;
    std::mt19937 random(20141);
    Correspondences sample;
    {
        const Correspondences p = normalised(points);
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i) {
            if (p.weight[i] > 0) order.push_back(i);
        }
        const std::size_t count = std::min<std::size_t>(kSearchPoints, order.size());
        if (count < sample_size) return std::nullopt;
        for (std::size_t i = 0; i < count; ++i) {
            std::swap(order[i], order[i + random() % (order.size() - i)]);
            const std::size_t at = order[i];
            sample.add({p.from_x[at], p.from_y[at]}, {p.to_x[at], p.to_y[at]}, p.weight[at]);
        }
    }
    const auto tolerance = static_cast<float>(tolerance_px * per_px_ * tolerance_px * per_px_);
    double best_cost = 1e30;
    HomographyParameters best{};
    std::vector<float> squares;
    const auto count = std::size_t(sample.size());
    int rounds = search_rounds_;
    for (int round = 0; round < rounds; ++round) {
        std::size_t at[4] = {};
        bool distinct = true;
        for (std::size_t k = 0; k < sample_size; ++k) {
            at[k] = random() % count;
            for (std::size_t j = 0; j < k; ++j) distinct = distinct && at[j] != at[k];
        }
        HomographyParameters h{};
        if (!distinct) continue;
        if (!(model == MotionModel::similarity ? similarityThrough(sample, at, h) : homographyThrough(sample, at, h))) {
            continue;
        }
        Cost cost = costOf(sample, h, tolerance, squares);
        if (cost.sum >= best_cost) continue;
        if (model == MotionModel::homography) {
            // Four noisy points extrapolate badly; the points that agree make a far better map of it.
            HomographyParameters improved = h;
            bool sound = true;
            for (int step = 0; step < 3 && sound; ++step) {
                sound = improve(sample, improved, 2 * tolerance_px * per_px_, 0.3 * tolerance_px * per_px_,
                                projective_deviation_)
                            .has_value();
            }
            const Cost then = sound ? costOf(sample, improved, tolerance, squares) : cost;
            if (then.sum < cost.sum) {
                cost = then;
                h = improved;
            }
        }
        best_cost = cost.sum;
        best = h;
        // Stop once a better sample would have turned up with 99.9 % probability.
        const double all_good = std::pow(double(cost.agreeing) / double(count), double(sample_size));
        const double needed = all_good >= 0.999 ? 1 : std::log(0.001) / std::log(1 - std::max(all_good, 1e-6));
        rounds = std::min(rounds, std::max(20, static_cast<int>(std::min(needed, 1e6)) + 1));
    }
    if (best_cost >= 1e30) return std::nullopt;
    const cv::Matx33d to_normalised = normalisedFromPx();
    return scaledToOne(to_normalised.inv() * matrixOf(best) * to_normalised);
}

bool plausibleMotion(const cv::Matx33d& m, cv::Size image) {
    const double xs[3] = {0, (image.width - 1) / 2.0, image.width - 1.0};
    const double ys[3] = {0, (image.height - 1) / 2.0, image.height - 1.0};
    const double determinant = cv::determinant(m);
    for (const double x : xs) {
        for (const double y : ys) {
            const double w = m(2, 0) * x + m(2, 1) * y + m(2, 2);
            if (!(w > 0.3)) return false;
            // The Jacobian's determinant of a projective map is det(M) / w³.
            const double area = determinant / (w * w * w);
            if (!(area > 1.0 / 16 && area < 16)) return false;
            const double u = (m(0, 0) * x + m(0, 1) * y + m(0, 2)) / w;
            const double v = (m(1, 0) * x + m(1, 1) * y + m(1, 2)) / w;
            if (!(std::abs(u - x) < image.width && std::abs(v - y) < image.height)) return false;
        }
    }
    return true;
}

}  // namespace eyrie
