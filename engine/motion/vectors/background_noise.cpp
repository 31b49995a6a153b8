#include "motion/vectors/background_noise.h"

#include <algorithm>

#include "motion/vectors/upper_median.h"

namespace eyrie {
namespace {

constexpr double kRayleighMedian = 1.17741;  ///< median of a Rayleigh distribution with σ = 1

}  // namespace

BackgroundNoise::BackgroundNoise(int longest_baseline)
    : speeds_(static_cast<std::size_t>(longest_baseline) + 1), sigma_(speeds_.size(), 0.0) {}

void BackgroundNoise::add(int baseline, double speed) {
    speeds_[static_cast<std::size_t>(baseline)].push_back(static_cast<float>(speed));
}

void BackgroundNoise::finish() {
    std::vector<float> displacements;
    for (std::size_t n = 1; n < speeds_.size(); ++n) {
        for (const float speed : speeds_[n]) displacements.push_back(speed * static_cast<float>(n));
    }
    if (displacements.empty()) return;
    const double pooled = upperMedianOf(displacements) / kRayleighMedian;
    for (std::size_t n = 1; n < speeds_.size(); ++n) {
        sigma_[n] = speeds_[n].size() >= kEnoughCorners ? upperMedianOf(speeds_[n]) / kRayleighMedian
                                                        : pooled / static_cast<double>(n);
    }
}

double BackgroundNoise::sigma(int baseline) const {
    return sigma_[static_cast<std::size_t>(std::clamp(baseline, 0, static_cast<int>(sigma_.size()) - 1))];
}

double BackgroundNoise::usual(int baseline) const {
    return kRayleighMedian * sigma(baseline);
}

}  // namespace eyrie
