#include "learning/classifiers/random_naive_bayes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace eyrie {

double LikelihoodHistogram::logDensityOf(double value) const {
    const double range = high - low;
    const double position = (value - low) / range * kBins;
    const auto bin = static_cast<std::size_t>(std::clamp(position, 0.0, kBins - 1.0));
    const double beyond = std::max({0.0, low - value, value - high}) / (range / 2);
    return log_density[bin] - std::min(beyond, 10.0);
}

double WeakBayes::posterior(const Eigen::VectorXd& values) const {
    double log_likelihood[2];
    for (std::size_t c = 0; c < 2; ++c) {
        const bool mixed = unmixing[c].unmixing.size() > 0;
        const Eigen::VectorXd components = mixed ? unmixing[c].apply(values) : values;
        log_likelihood[c] = mixed ? unmixing[c].log_volume : 0;
        for (Eigen::Index j = 0; j < components.size(); ++j) {
            log_likelihood[c] += likelihoods[c][static_cast<std::size_t>(j)].logDensityOf(components[j]);
        }
    }
    return 1 / (1 + std::exp(std::clamp(log_likelihood[0] - log_likelihood[1], -500.0, 500.0)));
}

RandomNaiveBayes::RandomNaiveBayes(ClassifierKind kind, std::vector<float> mean, std::vector<float> scale,
                                   std::vector<WeakBayes> weak)
    : kind_(kind), mean_(std::move(mean)), scale_(std::move(scale)), weak_(std::move(weak)) {}

double RandomNaiveBayes::decide(std::span<const float> features) const {
    double sum = 0;
    double weights = 0;
    Eigen::VectorXd values;
    for (const WeakBayes& weak : weak_) {
        values.resize(static_cast<Eigen::Index>(weak.features.size()));
        for (Eigen::Index j = 0; j < values.size(); ++j) {
            const auto f = static_cast<std::size_t>(weak.features[static_cast<std::size_t>(j)]);
            values[j] = (features[f] - mean_[f]) * scale_[f];
        }
        sum += weak.weight * (weak.posterior(values) - 0.5);
        weights += std::abs(weak.weight);
    }
    return weights > 0 ? sum / weights : 0;
}

void RandomNaiveBayes::write(ByteWriter& out) const {
    out.putAll(mean_);
    out.putAll(scale_);
    out.put(static_cast<std::int32_t>(weak_.size()));
    for (const WeakBayes& weak : weak_) {
        out.put(static_cast<float>(weak.weight));
        out.put(static_cast<std::int32_t>(weak.features.size()));
        for (const int feature : weak.features) out.put(static_cast<std::int32_t>(feature));
        for (std::size_t c = 0; c < 2; ++c) {
            for (const LikelihoodHistogram& histogram : weak.likelihoods[c]) {
                out.put(histogram.low);
                out.put(histogram.high);
                for (const float value : histogram.log_density) out.put(value);
            }
            const Unmixing& unmixing = weak.unmixing[c];
            out.put(static_cast<std::uint8_t>(unmixing.unmixing.size() > 0));
            if (unmixing.unmixing.size() == 0) continue;
            out.put(unmixing.log_volume);
            for (const double value : unmixing.mean) out.put(value);
            for (const double value : unmixing.unmixing.reshaped()) out.put(value);
        }
    }
}

namespace {

double finiteDouble(ByteReader& in) {
    const auto value = in.get<double>();
    if (!std::isfinite(value)) in.damaged("a number is not finite");
    return value;
}

LikelihoodHistogram readHistogram(ByteReader& in) {
    LikelihoodHistogram histogram;
    histogram.low = in.getFinite();
    histogram.high = in.getFinite();
    if (!(histogram.high > histogram.low)) in.damaged("a histogram has no range");
    for (float& value : histogram.log_density) value = in.getFinite();
    return histogram;
}

Unmixing readUnmixing(Eigen::Index size, ByteReader& in) {
    Unmixing unmixing;
    unmixing.log_volume = finiteDouble(in);
    unmixing.mean.resize(size);
    for (double& value : unmixing.mean) value = finiteDouble(in);
    unmixing.unmixing.resize(size, size);
    for (double& value : unmixing.unmixing.reshaped()) value = finiteDouble(in);
    return unmixing;
}

}  // namespace

std::unique_ptr<RandomNaiveBayes> RandomNaiveBayes::read(ClassifierKind kind, int dimension, ByteReader& in) {
    auto mean = in.getFiniteAll(static_cast<std::size_t>(dimension), "feature means");
    auto scale = in.getFiniteAll(static_cast<std::size_t>(dimension), "feature scales");
    std::vector<WeakBayes> all;
    const int count = in.getInt(1, 100000, "the number of weak classifiers");
    for (int k = 0; k < count; ++k) {
        WeakBayes weak;
        weak.weight = in.getFinite();
        const int size = in.getInt(1, 64, "the number of features");
        for (int j = 0; j < size; ++j) weak.features.push_back(in.getInt(0, dimension - 1, "a feature"));
        for (std::size_t c = 0; c < 2; ++c) {
            for (int j = 0; j < size; ++j) weak.likelihoods[c].push_back(readHistogram(in));
            if (in.get<std::uint8_t>() != 0) weak.unmixing[c] = readUnmixing(size, in);
        }
        all.push_back(std::move(weak));
    }
    return std::make_unique<RandomNaiveBayes>(kind, std::move(mean), std::move(scale), std::move(all));
}

}  // namespace eyrie
