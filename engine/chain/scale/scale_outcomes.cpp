#include "chain/scale/scale_outcomes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace eyrie {
namespace {

constexpr double kFinest = 0.04;    ///< m/px, first assumption
constexpr double kStep = 1.4;       ///< from one assumption to the next
constexpr double kFewestLooks = 8;  ///< sure windows under the best assumption; fewer are chance
constexpr int kReach = 2;           ///< assumptions on both sides of the best one that have a say
constexpr double kOwnError = 0.11;  ///< standard error of the logarithm where very many vehicles drive
/// Of the logarithm within one step of the assumptions.
const double kStepVariance = std::log(kStep) * std::log(kStep) / 12;
constexpr double kSure = 1.645;  ///< standard errors that hold 90 %

}  // namespace

double assumedGsd(int i) {
    return kFinest * std::pow(kStep, i);
}

double ScaleOutcome::score() const {
    if (looks <= 0) return 0;
    const double alike = looks / detections;
    const double car_sized = (cars + 1) / (tracks + 2);
    return decision * alike * alike * car_sized * car_sized;
}

bool ScaleOutcome::showsTraffic() const {
    return looks >= kFewestLooks && cars >= 1;
}

ScaleOutcome operator+(const ScaleOutcome& a, const ScaleOutcome& b) {
    return {a.detections + b.detections, a.looks + b.looks, a.decision + b.decision, a.tracks + b.tracks,
            a.cars + b.cars};
}

bool isCarSized(double length_m, double width_m) {
    return length_m > 3.6 && length_m < 6.6 && width_m > 1.5 && width_m < 3.8;
}

std::optional<ScaleEstimate> estimateOfScale(const std::vector<ScaleOutcome>& outcomes) {
    int best = 0;
    for (int i = 0; i < kScaleAssumptions; ++i) {
        const double score = outcomes[static_cast<std::size_t>(i)].score();
        if (score > outcomes[static_cast<std::size_t>(best)].score()) best = i;
    }
    const ScaleOutcome& peak = outcomes[static_cast<std::size_t>(best)];
    if (!peak.showsTraffic()) return std::nullopt;
    double weights = 0;
    double sum = 0;
    double squares = 0;
    for (int i = std::max(0, best - kReach); i <= std::min(kScaleAssumptions - 1, best + kReach); ++i) {
        const double share = outcomes[static_cast<std::size_t>(i)].score() / peak.score();
        const double weight = share * share;
        const double place = std::log(assumedGsd(i));
        weights += weight;
        sum += weight * place;
        squares += weight * place * place;
    }
    const double middle = sum / weights;
    const double spread = squares / weights - middle * middle + kStepVariance;
    ScaleEstimate estimate;
    estimate.gsd_m_per_px = std::exp(middle);
    estimate.vehicles = static_cast<int>(peak.cars);
    estimate.uncertainty = std::exp(kSure * std::sqrt(kOwnError * kOwnError + spread / peak.cars));
    return estimate;
}

}  // namespace eyrie
