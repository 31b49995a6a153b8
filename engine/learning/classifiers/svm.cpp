#include "learning/classifiers/svm.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <utility>

#include "core/error.h"
#include "learning/classifiers/seeded_random.h"
#include "learning/classifiers/smo_solver.h"

namespace eyrie {
namespace {

constexpr int kMostSamples = 12000;
constexpr float kFarthest = 4;
constexpr double kCosts[] = {1, 4, 16, 64};
/// γ in units of 1 / median squared distance between samples.
constexpr double kWidths[] = {0.25, 0.5, 1, 2, 4};

using Rows = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

Rows rowsOf(const cv::Mat1f& matrix) {
    return {matrix.ptr<float>(), matrix.rows, matrix.cols};
}

void standardise(const Standardisation& standard, std::span<const float> features, float* out) {
    for (std::size_t f = 0; f < features.size(); ++f) {
        out[f] = std::clamp((features[f] - standard.mean[f]) * standard.scale[f], -kFarthest, kFarthest);
    }
}

cv::Mat1f standardiseAll(const Standardisation& standard, const cv::Mat1f& features) {
    cv::Mat1f result(features.size());
    for (int i = 0; i < features.rows; ++i) {
        standardise(standard, {features[i], static_cast<std::size_t>(features.cols)}, result[i]);
    }
    return result;
}

/// |a − b|² between all rows.
cv::Mat1f squaredDistances(const cv::Mat1f& a, const cv::Mat1f& b) {
    const Rows rows_a = rowsOf(a);
    const Rows rows_b = rowsOf(b);
    cv::Mat1f result(a.rows, b.rows);
    Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> out(result.ptr<float>(), a.rows,
                                                                                          b.rows);
    out.noalias() = -2 * rows_a * rows_b.transpose();
    out.colwise() += rows_a.rowwise().squaredNorm();
    out.rowwise() += rows_b.rowwise().squaredNorm().transpose();
    out = out.cwiseMax(0.F);
    return result;
}

cv::Mat1f kernelOf(const cv::Mat1f& distances, double gamma) {
    cv::Mat1f kernel;
    cv::exp(distances * -gamma, kernel);
    return kernel;
}

cv::Mat1f selected(const cv::Mat1f& matrix, const std::vector<int>& rows, const std::vector<int>& columns) {
    cv::Mat1f result(static_cast<int>(rows.size()), static_cast<int>(columns.size()));
    for (int i = 0; i < result.rows; ++i) {
        const float* from = matrix[rows[static_cast<std::size_t>(i)]];
        for (int j = 0; j < result.cols; ++j) result(i, j) = from[columns[static_cast<std::size_t>(j)]];
    }
    return result;
}

double medianOf(const cv::Mat1f& distances) {
    std::vector<float> values;
    const int step = std::max(1, distances.rows / 300);
    for (int i = 0; i < distances.rows; i += step) {
        for (int j = 0; j < i; j += step) values.push_back(distances(i, j));
    }
    if (values.empty()) return 1;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return std::max<double>(*middle, 1e-6);
}

/// Fold of every sample, each class spread evenly.
std::vector<int> drawFolds(const std::vector<int>& labels, int folds, std::uint64_t seed) {
    SeededRandom random(seed);
    std::vector<int> order(labels.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    random.shuffle(order);
    std::vector<int> fold(labels.size());
    int next[2] = {};
    for (const int i : order) {
        const auto at = static_cast<std::size_t>(i);
        fold[at] = next[labels[at] > 0 ? 1 : 0]++ % folds;
    }
    return fold;
}

/// Share of samples that a machine trained on the other folds gets right, both classes counting the same.
double crossValidated(const cv::Mat1f& kernel, const std::vector<int>& labels, const std::vector<int>& fold, int folds,
                      double c) {
    double right[2] = {};
    double all[2] = {};
    for (int held_out = 0; held_out < folds; ++held_out) {
        std::vector<int> train;
        std::vector<int> test;
        std::vector<int> train_labels;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            (fold[i] == held_out ? test : train).push_back(static_cast<int>(i));
            if (fold[i] != held_out) train_labels.push_back(labels[i]);
        }
        const SmoSolution solution = solveSmo(selected(kernel, train, train), train_labels, c);
        for (const int i : test) {
            double decision = solution.bias;
            for (std::size_t k = 0; k < train.size(); ++k) {
                decision += solution.alpha[k] * train_labels[k] * kernel(i, train[k]);
            }
            const int label = labels[static_cast<std::size_t>(i)];
            all[label > 0 ? 1 : 0] += 1;
            if ((decision > 0) == (label > 0)) right[label > 0 ? 1 : 0] += 1;
        }
    }
    return (right[0] / std::max(all[0], 1.0) + right[1] / std::max(all[1], 1.0)) / 2;
}

}  // namespace

Svm::Svm(Standardisation standard, cv::Mat1f vectors, std::vector<float> weights, double bias, double gamma, double c)
    : standard_(std::move(standard)),
      vectors_(std::move(vectors)),
      weights_(std::move(weights)),
      bias_(bias),
      gamma_(gamma),
      c_(c) {}

double Svm::decide(std::span<const float> features) const {
    const cv::Mat1f row(1, static_cast<int>(features.size()), const_cast<float*>(features.data()));
    return decideAll(row).front();
}

std::vector<double> Svm::decideAll(const cv::Mat1f& features) const {
    constexpr int kAtOnce = 256;
    std::vector<double> values(static_cast<std::size_t>(features.rows));
    const int parts = (features.rows + kAtOnce - 1) / kAtOnce;
    cv::parallel_for_(cv::Range(0, parts), [&](const cv::Range& range) {
        for (int part = range.start; part < range.end; ++part) {
            const int begin = part * kAtOnce;
            const int end = std::min(begin + kAtOnce, features.rows);
            const cv::Mat1f x = standardiseAll(standard_, features.rowRange(begin, end));
            const cv::Mat1f kernel = kernelOf(squaredDistances(x, vectors_), gamma_);
            for (int i = begin; i < end; ++i) {
                double sum = bias_;
                const float* row = kernel[i - begin];
                for (std::size_t k = 0; k < weights_.size(); ++k) sum += static_cast<double>(weights_[k]) * row[k];
                values[static_cast<std::size_t>(i)] = sum;
            }
        }
    });
    return values;
}

void Svm::write(ByteWriter& out) const {
    out.putAll(standard_.mean);
    out.putAll(standard_.scale);
    out.put(bias_);
    out.put(gamma_);
    out.put(c_);
    out.putAll(weights_);
    out.putAll(std::span<const float>(vectors_.ptr<float>(), vectors_.total()));
}

std::unique_ptr<Svm> Svm::read(int dimension, ByteReader& in) {
    Standardisation standard;
    standard.mean = in.getFiniteAll(static_cast<std::size_t>(dimension), "feature means");
    standard.scale = in.getFiniteAll(static_cast<std::size_t>(dimension), "feature scales");
    const auto bias = in.get<double>();
    const auto gamma = in.get<double>();
    const auto c = in.get<double>();
    if (!std::isfinite(bias) || !std::isfinite(gamma) || !(gamma > 0) || !std::isfinite(c)) {
        in.damaged("a number is not usable");
    }
    auto weights = in.getAll<float>(static_cast<std::size_t>(kMostSamples), "support vectors");
    for (const float weight : weights) {
        if (!std::isfinite(weight)) in.damaged("a number is not finite");
    }
    if (weights.empty()) in.damaged("no support vector");
    const auto values = in.getFiniteAll(weights.size() * static_cast<std::size_t>(dimension), "support vectors");
    cv::Mat1f vectors(static_cast<int>(weights.size()), dimension);
    std::copy(values.begin(), values.end(), vectors.begin());
    return std::make_unique<Svm>(std::move(standard), vectors, std::move(weights), bias, gamma, c);
}

std::unique_ptr<Svm> trainSvm(const TrainingSet& set, int folds, std::uint64_t seed, const TrainingWatch& watch) {
    if (set.count() > kMostSamples) {
        throw Error(ErrorKind::input, "support vector machine: " + std::to_string(set.count()) +
                                          " training samples, but at most " + std::to_string(kMostSamples) +
                                          " are possible; use fewer or another classifier");
    }
    requireTrainable(set, folds);
    Standardisation standard = standardisationOf(set.features);
    const cv::Mat1f x = standardiseAll(standard, set.features);
    const cv::Mat1f distances = squaredDistances(x, x);
    std::vector<int> labels;
    for (const std::uint8_t vehicle : set.vehicle) labels.push_back(vehicle ? 1 : -1);
    const std::vector<int> fold = drawFolds(labels, folds, seed);
    const double unit = 1 / medianOf(distances);

    constexpr int costs = std::size(kCosts);
    constexpr int widths = std::size(kWidths);
    double score[widths][costs] = {};
    for (int w = 0; w < widths; ++w) {
        if (watch.stopped()) return nullptr;
        const cv::Mat1f kernel = kernelOf(distances, kWidths[w] * unit);
        cv::parallel_for_(cv::Range(0, costs), [&](const cv::Range& range) {
            for (int c = range.start; c < range.end && !watch.stopped(); ++c) {
                score[w][c] = crossValidated(kernel, labels, fold, folds, kCosts[c]);
            }
        });
        watch.show("cross validation", (w + 1.0) / (widths + 1));
    }
    if (watch.stopped()) return nullptr;
    int best_width = 0;
    int best_cost = 0;
    for (int c = 0; c < costs; ++c) {
        for (int w = 0; w < widths; ++w) {
            if (score[w][c] > score[best_width][best_cost]) {
                best_width = w;
                best_cost = c;
            }
        }
    }
    const double gamma = kWidths[best_width] * unit;
    const SmoSolution solution = solveSmo(kernelOf(distances, gamma), labels, kCosts[best_cost]);
    std::vector<float> weights;
    cv::Mat1f vectors(0, set.dimension());
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (solution.alpha[i] <= 0) continue;
        weights.push_back(static_cast<float>(solution.alpha[i] * labels[i]));
        vectors.push_back(x.row(static_cast<int>(i)));
    }
    watch.show("cross validation", 1);
    return std::make_unique<Svm>(std::move(standard), vectors, std::move(weights), solution.bias, gamma,
                                 kCosts[best_cost]);
}

}  // namespace eyrie
