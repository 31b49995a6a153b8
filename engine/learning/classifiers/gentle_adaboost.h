#pragma once

#include <array>
#include <vector>

#include "learning/classifiers/classifier.h"

namespace eyrie {

/// A tree of depth 2. `feature[0]` and `threshold[0]` decide between the two below it (1: less, 2: at least), which
/// lead to the leaves 0, 1 and 2, 3.
struct BoostedTree {
    std::array<int, 3> feature{};
    std::array<float, 3> threshold{};    ///< a value ≥ the threshold goes to the right
    std::array<std::int16_t, 4> leaf{};  ///< in 1/512, −512 … 512
};

/// Gentle AdaBoost over trees of depth 2 (Friedman, Hastie, Tibshirani 2000; Teutsch §7.3.3). The decision value is the
/// sum of the leaves. Leaves are multiples of 1/512, so that sums are exact in whatever order and number format.
class GentleAdaBoost : public Classifier {
 public:
    static constexpr int kLeafUnit = 512;

    /// `least_sums[t]` is the lowest sum of the leaves of trees 0 … t that an accepted training vehicle had (without
    /// the 1 % least sure ones): the trace for rejecting windows early (soft cascade).
    GentleAdaBoost(int dimension, std::vector<BoostedTree> trees, std::vector<float> least_sums);

    ClassifierKind kind() const override { return ClassifierKind::adaboost; }
    int dimension() const override { return dimension_; }
    double decide(std::span<const float> features) const override;
    void write(ByteWriter& out) const override;
    static std::unique_ptr<GentleAdaBoost> read(int dimension, ByteReader& in);

    const std::vector<BoostedTree>& trees() const { return trees_; }
    const std::vector<float>& leastSums() const { return least_sums_; }

 private:
    int dimension_;
    std::vector<BoostedTree> trees_;
    std::vector<float> least_sums_;
};

/// Each tree chooses its splits among a random share of the features, by all samples but those of the smallest weights
/// that hold no more than `weight_trimming` of the whole weight. Null when stopped.
std::unique_ptr<GentleAdaBoost> trainGentleAdaBoost(const TrainingSet& set, int trees, double feature_share,
                                                    double weight_trimming, std::uint64_t seed,
                                                    const TrainingWatch& watch);

}  // namespace eyrie
