#pragma once

#include <array>
#include <vector>

#include "learning/classifiers/classifier.h"
#include "learning/classifiers/fast_ica.h"

namespace eyrie {

/// Likelihoods of one component under one class: a histogram over an evenly divided range.
struct LikelihoodHistogram {
    static constexpr int kBins = 24;
    float low = 0;
    float high = 1;                          ///< > low
    std::array<float, kBins> log_density{};  ///< ln of probability per unit; values outside the range get the end bins'
                                             ///< less one for each half range of distance
    double logDensityOf(double value) const;
};

/// A Naïve Bayes classifier over a few features (Teutsch eq. 5.23, 5.24).
struct WeakBayes {
    double weight = 0;          ///< w_k = ½ ln((1 − e) / e)
    std::vector<int> features;  ///< indices, F of them
    /// Unmixing per class (not vehicle, vehicle) of the standardised features. Empty matrices: none.
    std::array<Unmixing, 2> unmixing;
    std::array<std::vector<LikelihoodHistogram>, 2> likelihoods;  ///< per class, one per component

    /// P(vehicle | features) with P(c) = 0.5; `values` are standardised. Densities of class-conditional components are
    /// scaled by their own unmixing's volume, without which eq. 5.24 would compare different units.
    double posterior(const Eigen::VectorXd& values) const;
};

/// The modified Random Naïve Bayes classifier (Teutsch §5.4.3, algorithm 2), plain, with ICA or with class-conditional
/// ICA. The decision value is Σ w_k · (P_k(vehicle) − ½) / Σ |w_k|, in −½ … ½.
class RandomNaiveBayes : public Classifier {
 public:
    RandomNaiveBayes(ClassifierKind kind, std::vector<float> mean, std::vector<float> scale,
                     std::vector<WeakBayes> weak);

    ClassifierKind kind() const override { return kind_; }
    int dimension() const override { return static_cast<int>(mean_.size()); }
    double decide(std::span<const float> features) const override;
    void write(ByteWriter& out) const override;
    static std::unique_ptr<RandomNaiveBayes> read(ClassifierKind kind, int dimension, ByteReader& in);

    const std::vector<WeakBayes>& weak() const { return weak_; }

 private:
    ClassifierKind kind_;
    std::vector<float> mean_;   ///< of the training set
    std::vector<float> scale_;  ///< 1 / deviation; 0 where a feature did not vary
    std::vector<WeakBayes> weak_;
};

/// Null when stopped. Throws Error(input) when nearly all weak classifiers exceed `max_weak_error`.
std::unique_ptr<RandomNaiveBayes> trainRandomNaiveBayes(const TrainingSet& set, ClassifierKind kind,
                                                        const ClassifierOptions& options, std::uint64_t seed,
                                                        const TrainingWatch& watch);

}  // namespace eyrie
