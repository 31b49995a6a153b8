#include "learning/descriptors/haralick.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace eyrie {
namespace {

constexpr int kLevels = kHaralickLevels;
using Probabilities = std::array<std::array<double, kLevels>, kLevels>;

/// Share of each pair of levels; all 0 when no pair fits into the image.
Probabilities cooccurrence(const cv::Mat& levels, cv::Point step) {
    std::array<std::array<int, kLevels>, kLevels> counts{};
    int pairs = 0;
    for (int y = std::max(0, -step.y); y < levels.rows - std::max(0, step.y); ++y) {
        const uchar* from = levels.ptr<uchar>(y);
        const uchar* to = levels.ptr<uchar>(y + step.y);
        for (int x = std::max(0, -step.x); x < levels.cols - std::max(0, step.x); ++x) {
            ++counts[from[x]][to[x + step.x]];
            ++counts[to[x + step.x]][from[x]];
            pairs += 2;
        }
    }
    Probabilities p{};
    for (int i = 0; i < kLevels; ++i) {
        for (int j = 0; j < kLevels; ++j) p[i][j] = pairs > 0 ? static_cast<double>(counts[i][j]) / pairs : 0.0;
    }
    return p;
}

double entropyTerm(double p) {
    return p > 0 ? -p * std::log2(p) : 0.0;
}

double varianceOf(const double* p, int count, double mean) {
    double variance = 0;
    for (int k = 0; k < count; ++k) variance += (k - mean) * (k - mean) * p[k];
    return variance;
}

}  // namespace

std::array<float, kHaralickFeatures> haralickFeatures(const cv::Mat& levels, cv::Point step) {
    const Probabilities p = cooccurrence(levels, step);
    double marginal[kLevels] = {};  // of rows and, as pairs count both ways, of columns
    double sums[2 * kLevels - 1] = {};
    double differences[kLevels] = {};
    double square_sum = 0;
    double product_mean = 0;
    double inverse_difference = 0;
    double entropy = 0;
    for (int i = 0; i < kLevels; ++i) {
        for (int j = 0; j < kLevels; ++j) {
            const double share = p[i][j];
            if (share == 0) continue;
            marginal[i] += share;
            sums[i + j] += share;
            differences[std::abs(i - j)] += share;
            square_sum += share * share;
            product_mean += share * i * j;
            inverse_difference += share / (1 + (i - j) * (i - j));
            entropy += entropyTerm(share);
        }
    }
    double mean = 0;
    double contrast = 0;
    double sum_mean = 0;
    double difference_mean = 0;
    double sum_entropy = 0;
    double difference_entropy = 0;
    double marginal_entropy = 0;
    for (int k = 0; k < kLevels; ++k) {
        mean += k * marginal[k];
        contrast += k * k * differences[k];
        difference_mean += k * differences[k];
        difference_entropy += entropyTerm(differences[k]);
        marginal_entropy += entropyTerm(marginal[k]);
    }
    for (int k = 0; k < 2 * kLevels - 1; ++k) {
        sum_mean += k * sums[k];
        sum_entropy += entropyTerm(sums[k]);
    }
    double crossed_entropy = 0;  // −Σ p(i,j) log(p(i) p(j)); it equals −Σ p(i) p(j) log(p(i) p(j)) for pairs both ways
    for (int i = 0; i < kLevels; ++i) {
        for (int j = 0; j < kLevels; ++j) crossed_entropy += entropyTerm(marginal[i] * marginal[j]);
    }
    const double variance = varianceOf(marginal, kLevels, mean);
    const double correlation = variance > 1e-12 ? (product_mean - mean * mean) / variance : 1.0;
    const double information = marginal_entropy > 1e-12 ? (entropy - crossed_entropy) / marginal_entropy : 0.0;
    const double dependence = std::sqrt(std::max(0.0, 1 - std::exp(-2 * std::max(0.0, crossed_entropy - entropy))));
    const double features[kHaralickFeatures] = {square_sum,
                                                contrast,
                                                correlation,
                                                variance,
                                                inverse_difference,
                                                sum_mean,
                                                varianceOf(sums, 2 * kLevels - 1, sum_mean),
                                                sum_entropy,
                                                entropy,
                                                varianceOf(differences, kLevels, difference_mean),
                                                difference_entropy,
                                                information,
                                                dependence};
    std::array<float, kHaralickFeatures> result{};
    std::copy(std::begin(features), std::end(features), result.begin());
    return result;
}

}  // namespace eyrie
