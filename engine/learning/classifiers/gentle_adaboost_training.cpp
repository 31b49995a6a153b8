#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/core/utility.hpp>

#include "learning/classifiers/feature_bins.h"
#include "learning/classifiers/gentle_adaboost.h"
#include "learning/classifiers/seeded_random.h"

namespace eyrie {
namespace {

/// Share of the accepted vehicles, those with the lowest sums, that have no say in what is rejected early: a few odd
/// ones would keep every window alive.
constexpr double kUnusualShare = 0.01;

struct Weighted {
    float weight;
    float weighted_label;
};

/// A split of one node and what it gains.
struct Split {
    int feature = 0;
    int bin = FeatureBins::kBins;  // samples with a code ≥ bin go right; none when nothing separates
    double gain = -1;
};

struct BinSums {
    float weight[FeatureBins::kBins];
    float label[FeatureBins::kBins];
};

void improve(Split& best, int feature, const BinSums& sums) {
    double weight = 0;
    double label = 0;
    for (int k = 0; k < FeatureBins::kBins; ++k) {
        weight += sums.weight[k];
        label += sums.label[k];
    }
    const double smallest = 1e-7 * weight;
    double left_weight = 0;
    double left_label = 0;
    for (int k = 1; k < FeatureBins::kBins; ++k) {
        left_weight += sums.weight[k - 1];
        left_label += sums.label[k - 1];
        const double right_weight = weight - left_weight;
        if (left_weight <= smallest || right_weight <= smallest) continue;
        const double right_label = label - left_label;
        const double gain = left_label * left_label / left_weight + right_label * right_label / right_weight;
        if (gain > best.gain) best = {feature, k, gain};
    }
}

class Boosting {
 public:
    /// Samples whose weights add up to no more than the share `weight_trimming` take no part in choosing splits; they
    /// still get new weights.
    Boosting(const TrainingSet& set, double feature_share, double weight_trimming, std::uint64_t seed)
        : set_(set),
          weight_trimming_(weight_trimming),
          bins_(set.features),
          random_(seed),
          chosen_(static_cast<std::size_t>(std::max(1.0, std::round(feature_share * set.dimension())))),
          all_features_(static_cast<std::size_t>(set.dimension())),
          sums_(set.vehicle.size(), 0),
          weights_(set.vehicle.size()),
          side_(set.vehicle.size()) {
        std::iota(all_features_.begin(), all_features_.end(), 0);
        double vehicles = 0;
        for (const std::uint8_t label : set.vehicle) vehicles += label;
        const double others = static_cast<double>(set.vehicle.size()) - vehicles;
        for (std::size_t i = 0; i < weights_.size(); ++i) weights_[i] = 0.5 / (set.vehicle[i] ? vehicles : others);
    }

    BoostedTree addTree() {
        drawFeatures();
        selectSamples();
        const Split root = bestSplits(false)[0];
        const auto root_codes = bins_.codes(root.feature);
        for (std::size_t i = 0; i < side_.size(); ++i) side_[i] = root_codes[i] >= root.bin ? 1 : 0;
        const auto below = bestSplits(true);
        BoostedTree tree;
        setNode(tree, 0, root);
        setNode(tree, 1, below[0]);
        setNode(tree, 2, below[1]);
        setLeaves(tree, below);
        return tree;
    }

    /// Sum of the leaves so far, in leaf units.
    const std::vector<int>& sums() const { return sums_; }

 private:
    void drawFeatures() {
        for (std::size_t i = 0; i < chosen_; ++i) {
            const auto left = static_cast<int>(all_features_.size() - i);
            std::swap(all_features_[i], all_features_[i + static_cast<std::size_t>(random_.below(left))]);
        }
    }

    void selectSamples() {
        std::vector<double> sorted = weights_;
        std::sort(sorted.begin(), sorted.end());
        const double total = std::accumulate(sorted.begin(), sorted.end(), 0.0);
        double dropped = 0;
        double limit = 0;
        for (const double weight : sorted) {
            dropped += weight;
            if (dropped > weight_trimming_ * total) {
                limit = weight;
                break;
            }
        }
        active_.clear();
        weighted_.clear();
        for (std::size_t i = 0; i < weights_.size(); ++i) {
            if (weights_[i] < limit) continue;
            active_.push_back(static_cast<std::uint32_t>(i));
            const auto weight = static_cast<float>(weights_[i] / total);
            weighted_.push_back({weight, set_.vehicle[i] ? weight : -weight});
        }
    }

    /// The best split of the root, or of the nodes on both sides of it.
    std::array<Split, 2> bestSplits(bool by_side) const {
        std::vector<std::array<Split, 2>> best(chosen_);
        cv::parallel_for_(cv::Range(0, static_cast<int>(chosen_)), [&](const cv::Range& range) {
            for (int c = range.start; c < range.end; ++c) {
                const int feature = all_features_[static_cast<std::size_t>(c)];
                const std::uint8_t* codes = bins_.codes(feature).data();
                BinSums sums[2] = {};
                for (std::size_t k = 0; k < active_.size(); ++k) {
                    const std::uint32_t i = active_[k];
                    BinSums& node = sums[by_side ? side_[i] : 0];
                    node.weight[codes[i]] += weighted_[k].weight;
                    node.label[codes[i]] += weighted_[k].weighted_label;
                }
                for (std::size_t node = 0; node < 2; ++node) {
                    improve(best[static_cast<std::size_t>(c)][node], feature, sums[node]);
                }
            }
        });
        std::array<Split, 2> result;
        for (const auto& candidate : best) {
            for (std::size_t node = 0; node < 2; ++node) {
                if (candidate[node].gain > result[node].gain) result[node] = candidate[node];
            }
        }
        return result;
    }

    void setNode(BoostedTree& tree, std::size_t node, const Split& split) const {
        tree.feature[node] = split.feature;
        const auto& borders = bins_.borders(split.feature);
        const bool separates = split.gain >= 0 && split.bin <= static_cast<int>(borders.size());
        tree.threshold[node] =
            separates ? borders[static_cast<std::size_t>(split.bin - 1)] : std::numeric_limits<float>::max();
    }

    void setLeaves(BoostedTree& tree, const std::array<Split, 2>& below) {
        const std::array<std::span<const std::uint8_t>, 2> codes{bins_.codes(below[0].feature),
                                                                 bins_.codes(below[1].feature)};
        std::vector<std::uint8_t> leaf_of(side_.size());
        double weight[4] = {};
        double label[4] = {};
        for (std::size_t i = 0; i < side_.size(); ++i) {
            const std::size_t side = side_[i];
            const std::size_t leaf = 2 * side + (codes[side][i] >= below[side].bin ? 1U : 0U);
            leaf_of[i] = static_cast<std::uint8_t>(leaf);
            weight[leaf] += weights_[i];
            label[leaf] += set_.vehicle[i] ? weights_[i] : -weights_[i];
        }
        for (std::size_t leaf = 0; leaf < 4; ++leaf) {
            const double value = weight[leaf] > 0 ? label[leaf] / weight[leaf] : 0;
            tree.leaf[leaf] = static_cast<std::int16_t>(std::lround(value * GentleAdaBoost::kLeafUnit));
        }
        double total = 0;
        for (std::size_t i = 0; i < side_.size(); ++i) {
            const int leaf = tree.leaf[leaf_of[i]];
            sums_[i] += leaf;
            const double agreement = (set_.vehicle[i] ? 1.0 : -1.0) * leaf / GentleAdaBoost::kLeafUnit;
            weights_[i] *= std::exp(-agreement);
            total += weights_[i];
        }
        for (double& w : weights_) w /= total;
    }

    const TrainingSet& set_;
    double weight_trimming_;
    FeatureBins bins_;
    SeededRandom random_;
    std::size_t chosen_;
    std::vector<int> all_features_;  // the first `chosen_` are this tree's
    std::vector<int> sums_;
    std::vector<double> weights_;
    std::vector<std::uint8_t> side_;
    std::vector<std::uint32_t> active_;
    std::vector<Weighted> weighted_;
};

/// Lowest sum after each tree among the vehicles that the whole sum accepts (≥ 0), but for those with the very lowest
/// final sums; all of them where none is accepted.
std::vector<float> leastSums(const std::vector<std::vector<int>>& vehicle_sums) {
    const std::vector<int>& final_sums = vehicle_sums.back();
    std::vector<int> accepted;
    for (const int sum : final_sums) {
        if (sum >= 0) accepted.push_back(sum);
    }
    int limit = std::numeric_limits<int>::min();
    if (!accepted.empty()) {
        const auto unusual = static_cast<std::ptrdiff_t>(kUnusualShare * static_cast<double>(accepted.size()));
        std::nth_element(accepted.begin(), accepted.begin() + unusual, accepted.end());
        limit = accepted[static_cast<std::size_t>(unusual)];
    }
    std::vector<float> least;
    for (const auto& sums : vehicle_sums) {
        int lowest = std::numeric_limits<int>::max();
        for (std::size_t i = 0; i < sums.size(); ++i) {
            if (final_sums[i] >= limit) lowest = std::min(lowest, sums[i]);
        }
        least.push_back(static_cast<float>(lowest) / GentleAdaBoost::kLeafUnit);
    }
    return least;
}

}  // namespace

std::unique_ptr<GentleAdaBoost> trainGentleAdaBoost(const TrainingSet& set, int trees, double feature_share,
                                                    double weight_trimming, std::uint64_t seed,
                                                    const TrainingWatch& watch) {
    Boosting boosting(set, feature_share, weight_trimming, seed);
    std::vector<BoostedTree> grown;
    std::vector<std::vector<int>> vehicle_sums;  // per tree
    for (int t = 0; t < trees; ++t) {
        if (watch.stopped()) return nullptr;
        grown.push_back(boosting.addTree());
        auto& sums = vehicle_sums.emplace_back();
        for (std::size_t i = 0; i < set.vehicle.size(); ++i) {
            if (set.vehicle[i]) sums.push_back(boosting.sums()[i]);
        }
        watch.show("boosting", (t + 1.0) / trees);
    }
    return std::make_unique<GentleAdaBoost>(set.dimension(), std::move(grown), leastSums(vehicle_sums));
}

}  // namespace eyrie
