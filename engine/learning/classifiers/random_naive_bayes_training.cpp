#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <opencv2/core/utility.hpp>
#include <optional>

#include "core/error.h"
#include "learning/classifiers/random_naive_bayes.h"
#include "learning/classifiers/seeded_random.h"
#include "learning/classifiers/standardisation.h"

namespace eyrie {
namespace {

/// FastICA sees at most so many samples of a bootstrap: its time grows with them, its result hardly changes.
constexpr int kIcaSamples = 400;
/// Directions in which a class hardly varies (bins that are nearly always empty) would drown all others.
constexpr double kLeastVariance = 0.05;
constexpr int kMostAttempts = 20;  // per weak classifier, until the training is given up

/// Histogram of `values` over [low, high], smoothed by a binomial kernel and by half a count in every bin.
LikelihoodHistogram histogramOf(const Eigen::VectorXd& values, double low, double high) {
    constexpr int bins = LikelihoodHistogram::kBins;
    LikelihoodHistogram histogram;
    const double margin = std::max(0.05 * (high - low), 1e-3);
    histogram.low = static_cast<float>(low - margin);
    histogram.high = static_cast<float>(high + margin);
    const double width = (static_cast<double>(histogram.high) - histogram.low) / bins;
    std::array<double, bins> counts{};
    for (const double value : values) {
        counts[static_cast<std::size_t>(std::clamp((value - histogram.low) / width, 0.0, bins - 1.0))] += 1;
    }
    const double total = static_cast<double>(values.size()) + 0.5 * bins;
    for (int k = 0; k < bins; ++k) {
        const double before = counts[static_cast<std::size_t>(std::max(k - 1, 0))];
        const double after = counts[static_cast<std::size_t>(std::min(k + 1, bins - 1))];
        const double smooth = (before + 2 * counts[static_cast<std::size_t>(k)] + after) / 4 + 0.5;
        histogram.log_density[static_cast<std::size_t>(k)] = static_cast<float>(std::log(smooth / total / width));
    }
    return histogram;
}

class WeakTrainer {
 public:
    WeakTrainer(const TrainingSet& set, const Standardisation& standard, ClassifierKind kind,
                const ClassifierOptions& options)
        : set_(set), standard_(standard), kind_(kind), features_(std::min(options.weak_features, set.dimension())) {
        for (std::size_t i = 0; i < set.vehicle.size(); ++i) {
            by_class_[set.vehicle[i]].push_back(static_cast<int>(i));
        }
    }

    /// One pass of algorithm 2's loop, and its out-of-bag error; nothing when a bootstrap lacks a class.
    std::optional<std::pair<WeakBayes, double>> train(std::uint64_t seed) const {
        SeededRandom random(seed);
        std::vector<std::uint8_t> in_bag(set_.vehicle.size(), 0);
        std::array<std::vector<int>, 2> bag;
        for (std::size_t k = 0; k < set_.vehicle.size(); ++k) {
            const int i = random.below(set_.count());
            in_bag[static_cast<std::size_t>(i)] = 1;
            bag[set_.vehicle[static_cast<std::size_t>(i)]].push_back(i);
        }
        if (bag[0].size() < 2 || bag[1].size() < 2) return {};
        WeakBayes weak;
        while (static_cast<int>(weak.features.size()) < features_) {
            const int feature = random.below(set_.dimension());
            if (std::find(weak.features.begin(), weak.features.end(), feature) == weak.features.end()) {
                weak.features.push_back(feature);
            }
        }
        const std::array<Eigen::MatrixXd, 2> values{rows(bag[0], weak.features), rows(bag[1], weak.features)};
        if (kind_ == ClassifierKind::cc_ica_random_naive_bayes) {
            for (std::size_t c = 0; c < 2; ++c)
                weak.unmixing[c] = fastIca(thinned(values[c]), random.next(), kLeastVariance);
        } else if (kind_ == ClassifierKind::ica_random_naive_bayes) {
            Eigen::MatrixXd all(values[0].rows() + values[1].rows(), values[0].cols());
            all << values[0], values[1];
            weak.unmixing[0] = weak.unmixing[1] = fastIca(thinned(all), random.next(), kLeastVariance);
        }
        fitLikelihoods(weak, values);
        return std::pair(weak, outOfBagError(weak, in_bag));
    }

 private:
    Eigen::MatrixXd rows(const std::vector<int>& samples, const std::vector<int>& features) const {
        Eigen::MatrixXd values(static_cast<Eigen::Index>(samples.size()), static_cast<Eigen::Index>(features.size()));
        for (Eigen::Index r = 0; r < values.rows(); ++r) {
            const float* row = set_.features[samples[static_cast<std::size_t>(r)]];
            for (Eigen::Index c = 0; c < values.cols(); ++c) {
                const auto f = static_cast<std::size_t>(features[static_cast<std::size_t>(c)]);
                values(r, c) = (row[f] - standard_.mean[f]) * standard_.scale[f];
            }
        }
        return values;
    }

    /// Every n-th row, so that at most kIcaSamples are left.
    static Eigen::MatrixXd thinned(const Eigen::MatrixXd& values) {
        const Eigen::Index step = (values.rows() + kIcaSamples - 1) / kIcaSamples;
        const Eigen::Index count = (values.rows() + step - 1) / step;
        return values(Eigen::seqN(0, count, step), Eigen::all);
    }

    static void fitLikelihoods(WeakBayes& weak, const std::array<Eigen::MatrixXd, 2>& values) {
        std::array<Eigen::MatrixXd, 2> components = values;
        for (std::size_t c = 0; c < 2; ++c) {
            const Unmixing& u = weak.unmixing[c];
            if (u.unmixing.size() > 0) {
                components[c] = (values[c].rowwise() - u.mean.transpose()) * u.unmixing.transpose();
            }
        }
        const bool own_range = weak.unmixing[0].unmixing.size() > 0 && weak.unmixing[0].mean != weak.unmixing[1].mean;
        for (Eigen::Index j = 0; j < values[0].cols(); ++j) {
            for (std::size_t c = 0; c < 2; ++c) {
                double low = components[c].col(j).minCoeff();
                double high = components[c].col(j).maxCoeff();
                if (!own_range) {
                    low = std::min(low, components[1 - c].col(j).minCoeff());
                    high = std::max(high, components[1 - c].col(j).maxCoeff());
                }
                weak.likelihoods[c].push_back(histogramOf(components[c].col(j), low, high));
            }
        }
    }

    /// Mean of both classes' error rates, in keeping with P(c) = 0.5 however many samples each class has.
    double outOfBagError(const WeakBayes& weak, const std::vector<std::uint8_t>& in_bag) const {
        double error = 0;
        for (std::size_t c = 0; c < 2; ++c) {
            std::vector<int> out;
            for (const int i : by_class_[c]) {
                if (!in_bag[static_cast<std::size_t>(i)]) out.push_back(i);
            }
            if (out.empty()) return 0.5;
            const Eigen::MatrixXd values = rows(out, weak.features);
            double wrong = 0;
            for (Eigen::Index r = 0; r < values.rows(); ++r) {
                const bool vehicle = weak.posterior(values.row(r).transpose()) > 0.5;
                wrong += vehicle != (c == 1) ? 1 : 0;
            }
            // Half an error more keeps the weight of a faultless classifier finite.
            error += (wrong + 0.5) / (static_cast<double>(out.size()) + 1) / 2;
        }
        return error;
    }

    const TrainingSet& set_;
    const Standardisation& standard_;
    ClassifierKind kind_;
    int features_;
    std::array<std::vector<int>, 2> by_class_;
};

}  // namespace

std::unique_ptr<RandomNaiveBayes> trainRandomNaiveBayes(const TrainingSet& set, ClassifierKind kind,
                                                        const ClassifierOptions& options, std::uint64_t seed,
                                                        const TrainingWatch& watch) {
    Standardisation standard = standardisationOf(set.features);
    const WeakTrainer trainer(set, standard, kind, options);
    const auto wanted = static_cast<std::size_t>(options.weak_classifiers);
    std::vector<std::optional<WeakBayes>> trained(wanted);
    std::atomic<bool> given_up{false};
    std::mutex mutex;
    double done = 0;
    cv::parallel_for_(cv::Range(0, options.weak_classifiers), [&](const cv::Range& range) {
        for (int k = range.start; k < range.end && !given_up; ++k) {
            SeededRandom seeds(seed + 0x51ed2701ULL * static_cast<std::uint64_t>(k + 1));
            auto& weak = trained[static_cast<std::size_t>(k)];
            for (int attempt = 0; attempt < kMostAttempts && !weak; ++attempt) {
                if (watch.stopped()) return;
                auto candidate = trainer.train(seeds.next());
                if (!candidate || candidate->second > options.max_weak_error) continue;
                const double error = candidate->second;
                weak = std::move(candidate->first);
                weak->weight = 0.5 * std::log((1 - error) / error);
            }
            if (!weak) given_up = true;
            const std::lock_guard lock(mutex);
            watch.show("weak classifiers", ++done / options.weak_classifiers);
        }
    });
    if (watch.stopped()) return nullptr;
    if (given_up) {
        throw Error(ErrorKind::input, "Random Naïve Bayes: no weak classifier stays below the error " +
                                          std::to_string(options.max_weak_error) +
                                          "; use other samples or raise training.max_weak_error");
    }
    std::vector<WeakBayes> weak;
    for (auto& one : trained) weak.push_back(std::move(*one));
    return std::make_unique<RandomNaiveBayes>(kind, std::move(standard.mean), std::move(standard.scale),
                                              std::move(weak));
}

}  // namespace eyrie
