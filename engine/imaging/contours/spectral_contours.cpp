#include "imaging/contours/spectral_contours.h"

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace eyrie {
namespace {

using Affinity = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr int kReach_px = 5;
constexpr double kContourScale = 0.1;
constexpr int kVibrations = 16;
constexpr int kLanczosSteps = 160;
constexpr int kMostPixels = 12'000;  // larger pictures are halved: vibrations are smooth
constexpr double kDerivative_px = 1;

float strongestBetween(const cv::Mat& contours, cv::Point a, cv::Point b) {
    const int steps = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
    float strongest = 0;
    for (int step = 0; step <= steps; ++step) {
        const double part = static_cast<double>(step) / steps;
        strongest = std::max(strongest,
                             contours.at<float>(cvRound(a.y + part * (b.y - a.y)), cvRound(a.x + part * (b.x - a.x))));
    }
    return strongest;
}

Affinity affinityOf(const cv::Mat& contours) {
    std::vector<Eigen::Triplet<double>> entries;
    const cv::Rect whole({0, 0}, contours.size());
    const auto number = [&](cv::Point p) { return p.y * contours.cols + p.x; };
    for (int y = 0; y < contours.rows; ++y) {
        for (int x = 0; x < contours.cols; ++x) {
            for (int dy = 0; dy <= kReach_px; ++dy) {
                for (int dx = dy == 0 ? 1 : -kReach_px; dx <= kReach_px; ++dx) {
                    const cv::Point other(x + dx, y + dy);
                    if (dx * dx + dy * dy > kReach_px * kReach_px || !whole.contains(other)) continue;
                    const double bound = std::exp(-strongestBetween(contours, {x, y}, other) / kContourScale);
                    entries.emplace_back(number({x, y}), number(other), bound);
                    entries.emplace_back(number(other), number({x, y}), bound);
                }
            }
        }
    }
    const int pixels = contours.rows * contours.cols;
    Affinity affinity(pixels, pixels);
    affinity.setFromTriplets(entries.begin(), entries.end());
    return affinity;
}

/// Gaussian derivative across a line of the given angle.
cv::Mat derivativeKernel(double angle) {
    const int reach = cvCeil(3 * kDerivative_px);
    cv::Mat kernel(2 * reach + 1, 2 * reach + 1, CV_32F);
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            const double across = -std::sin(angle) * x + std::cos(angle) * y;
            kernel.at<float>(y + reach, x + reach) =
                static_cast<float>(across * std::exp(-(x * x + y * y) / (2 * kDerivative_px * kDerivative_px)));
        }
    }
    return kernel / cv::norm(kernel, cv::NORM_L1);
}

}  // namespace

std::vector<Vibration> slowestVibrations(const cv::Mat& contours, int number) {
    CV_Assert(contours.type() == CV_32FC1);
    const int pixels = contours.rows * contours.cols;
    if (pixels < 3) return {};
    const Affinity affinity = affinityOf(contours);
    const Eigen::VectorXd root = (affinity * Eigen::VectorXd::Ones(pixels)).cwiseSqrt();
    const Eigen::VectorXd inverse_root = root.cwiseInverse();
    // The largest eigenvalues of D^−½ W D^−½ are 1 − λ; √D is its vector for λ = 0 and is kept out of the search.
    const Eigen::VectorXd constant = root.normalized();
    const auto steps = static_cast<Eigen::Index>(std::min(kLanczosSteps, pixels - 1));
    Eigen::MatrixXd basis(pixels, steps);
    Eigen::VectorXd diagonal(steps);
    Eigen::VectorXd beside(steps);
    Eigen::VectorXd next(pixels);
    for (int i = 0; i < pixels; ++i)
        next[i] = std::sin(1.0 + i * 0.7) + std::cos(0.3 * i * i);  // any start with no structure
    Eigen::Index done = 0;
    while (done < steps) {
        // Twice, since once leaves what rounding brought in.
        for (int turn = 0; turn < 2; ++turn) {
            next -= constant * constant.dot(next);
            next -= basis.leftCols(done) * (basis.leftCols(done).transpose() * next);
        }
        const double length = next.norm();
        if (done > 0) beside[done - 1] = length;
        if (length < 1e-10) break;  // nothing is left that the others do not span
        basis.col(done) = next / length;
        next = inverse_root.cwiseProduct(affinity * inverse_root.cwiseProduct(basis.col(done)));
        diagonal[done] = basis.col(done).dot(next);
        ++done;
    }
    if (done == 0) return {};
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(diagonal.head(done), beside.head(std::max<Eigen::Index>(done - 1, 0)));
    std::vector<Vibration> vibrations;
    for (Eigen::Index i = done - 1; i >= 0 && static_cast<int>(vibrations.size()) < number; --i) {
        const Eigen::VectorXd vector =
            inverse_root.cwiseProduct(basis.leftCols(done) * solver.eigenvectors().col(i)).normalized();
        cv::Mat picture(contours.size(), CV_32F);
        for (int pixel = 0; pixel < pixels; ++pixel) {
            picture.at<float>(pixel / contours.cols, pixel % contours.cols) = static_cast<float>(vector[pixel]);
        }
        vibrations.push_back({1 - solver.eigenvalues()[i], picture});
    }
    return vibrations;
}

DirectedPictures spectralCues(const cv::Mat& contours) {
    cv::Mat small = contours;
    while (small.rows * small.cols > kMostPixels) {
        cv::Mat halved;
        // The strongest contour of four pixels: a line of one pixel must not fade.
        cv::dilate(small, halved, cv::Mat::ones(2, 2, CV_8U), {0, 0});
        cv::resize(halved, small, {(small.cols + 1) / 2, (small.rows + 1) / 2}, 0, 0, cv::INTER_NEAREST);
    }
    DirectedPictures cues;
    for (cv::Mat& cue : cues) cue = cv::Mat::zeros(contours.size(), CV_32F);
    for (const Vibration& vibration : slowestVibrations(small, kVibrations)) {
        cv::Mat picture;
        cv::resize(vibration.picture, picture, contours.size(), 0, 0, cv::INTER_LINEAR);
        const double weight = 1 / std::sqrt(std::max(vibration.eigenvalue, 1e-6));
        for (int direction = 0; direction < kContourDirections; ++direction) {
            cv::Mat slope;
            cv::filter2D(picture, slope, CV_32F, derivativeKernel(contourAngle(direction)), {-1, -1}, 0,
                         cv::BORDER_REFLECT);
            cv::Mat& cue = cues[static_cast<std::size_t>(direction)];
            cue += cv::abs(slope) * weight;
        }
    }
    return cues;
}

}  // namespace eyrie
