#pragma once

#include <vector>

#include "learning/classifiers/classifier.h"
#include "learning/classifiers/standardisation.h"

namespace eyrie {

/// Support vector machine with the kernel K(a, b) = exp(−γ |a − b|²) over standardised features, cut at ±4 deviations
/// (Teutsch §7.3.3). The decision value is Σ α_i y_i K(x_i, x) + bias.
class Svm : public Classifier {
 public:
    /// `weights` are α_i y_i, one per row of `vectors` (standardised).
    Svm(Standardisation standard, cv::Mat1f vectors, std::vector<float> weights, double bias, double gamma, double c);

    ClassifierKind kind() const override { return ClassifierKind::svm; }
    int dimension() const override { return static_cast<int>(standard_.mean.size()); }
    double decide(std::span<const float> features) const override;
    std::vector<double> decideAll(const cv::Mat1f& features) const override;
    void write(ByteWriter& out) const override;
    static std::unique_ptr<Svm> read(int dimension, ByteReader& in);

    double gamma() const { return gamma_; }
    double c() const { return c_; }
    int vectors() const { return vectors_.rows; }

 private:
    Standardisation standard_;
    cv::Mat1f vectors_;
    std::vector<float> weights_;
    double bias_;
    double gamma_;
    double c_;
};

/// Chooses C and γ on a grid by cross validation with this many folds (most correct, ties by the smaller C, then γ),
/// then trains on all samples. Takes 4 bytes per pair of samples; throws Error(input) above 12,000 samples. Null when
/// stopped.
std::unique_ptr<Svm> trainSvm(const TrainingSet& set, int folds, std::uint64_t seed, const TrainingWatch& watch);

}  // namespace eyrie
