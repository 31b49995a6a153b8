#include "chain/scale/scale_outcomes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/robust_statistics.h"
#include "core/values/scene_scale.h"

namespace eyrie {
namespace {

constexpr double kFinest = 0.04;  ///< m/px, first assumption
constexpr double kStep = 1.4;     ///< from one assumption to the next
/// Powers of the shares in the score. Where the assumption is too fine little else is detected, and every other window
/// looks like a vehicle: so that counts less than what is as large as a car.
constexpr double kAlikePower = 0.75;
constexpr double kCarsPower = 4;
constexpr double kWholeCarsPower = 3;  ///< of the share of cars in what goes on looking like whole vehicles
constexpr double kMostlyRelief = 0.3;  ///< share of the detections below which such tracks may say otherwise …
constexpr double kMuchCoarser = 1.3;   ///< … by this factor at least
constexpr double kFewestLooks = 8;     ///< sure windows under the best assumption; fewer are chance
constexpr int kReach = 2;              ///< assumptions on both sides of the best one that have a say
constexpr double kOwnError = 0.11;     ///< standard error of the logarithm where very many vehicles drive
/// The same where hardly anything that is detected looks like a vehicle: over relief, at night, in haze.
constexpr double kErrorInDoubt = 0.45;
/// Shares of the detections that look like vehicles: below the first of a pair fully, above the second not at all.
constexpr std::pair kDoubted(0.2, 0.45);  ///< what they tell is doubted
constexpr std::pair kDrawn(0.1, 0.16);    ///< … and drawn to the scale that would be assumed without them
constexpr double kDrawnBy = 0.36;         ///< share of the logarithm: the doubt against a spread of .6 among videos
/// Of the logarithm, by which what is fully doubted seems larger than it is: lit or hazy ground counts as vehicle.
constexpr double kLargerInDoubt = 0.2;
/// The same at night, once more: headlights light a strip about each vehicle, which goes along with it.
constexpr double kLargerInDark = 0.3;
constexpr double kFast = 0.75;        ///< share of the cars that are no faster …
constexpr double kTownSpeed = 11;     ///< … than so many m/s
constexpr double kSpeedError = 0.45;  ///< standard error of its logarithm: between a jam and a motorway
/// Of the logarithm within one step of the assumptions.
const double kStepVariance = std::log(kStep) * std::log(kStep) / 12;
constexpr double kSure = 1.645;      ///< standard errors that hold 90 %
constexpr int kPlenty = 10;          ///< vehicles; where fewer drive, later frames are looked at, too
constexpr double kMostlyCars = 0.5;  ///< share of a view's tracks that have to be as large as a car

/// A logarithm that is known so well.
struct LogOfScale {
    double value = 0;
    double variance = 0;
};

/// Both together, by how sure they are.
LogOfScale combined(const LogOfScale& a, const LogOfScale& b) {
    const double variance = 1 / (1 / a.variance + 1 / b.variance);
    return {variance * (a.value / a.variance + b.value / b.variance), variance};
}

double partBelow(double share, const std::pair<double, double>& limits) {
    return std::clamp((limits.second - share) / (limits.second - limits.first), 0.0, 1.0);
}

/// What outcomes tell by some scores of them.
std::optional<ScaleEstimate> estimateBy(const std::vector<double>& scores, const std::vector<ScaleOutcome>& outcomes) {
    const auto highest = std::max_element(scores.begin(), scores.end());
    const auto best = static_cast<int>(highest - scores.begin());
    const ScaleOutcome& peak = outcomes[static_cast<std::size_t>(best)];
    if (*highest <= 0 || !peak.showsTraffic()) return std::nullopt;
    double weights = 0;
    double sum = 0;
    double squares = 0;
    for (int i = std::max(0, best - kReach); i <= std::min(kScaleAssumptions - 1, best + kReach); ++i) {
        const double share = scores[static_cast<std::size_t>(i)] / *highest;
        const double weight = share * share;
        const double place = std::log(assumedGsd(i));
        weights += weight;
        sum += weight * place;
        squares += weight * place * place;
    }
    const double middle = sum / weights;
    const double spread = squares / weights - middle * middle + kStepVariance;
    const double doubt = partBelow(peak.alike(), kDoubted);
    const double by_sizes = middle + doubt * kLargerInDoubt + peak.darkness() * kLargerInDark;
    const double drawn = kDrawnBy * partBelow(peak.alike(), kDrawn);
    const double own_error = kOwnError + doubt * (kErrorInDoubt - kOwnError);
    LogOfScale scale{by_sizes + drawn * (std::log(SceneScale().gsd_m_per_px) - by_sizes),
                     own_error * own_error + spread / peak.cars};
    const double fast = peak.car_speeds_m_s.empty() ? 0 : quantileOf(peak.car_speeds_m_s, kFast);
    if (fast > 0) {
        const double as_in_town = assumedGsd(best) * kTownSpeed / fast;
        scale = combined(scale, {std::log(as_in_town), kSpeedError * kSpeedError});
    }
    return ScaleEstimate{std::exp(scale.value), std::exp(kSure * std::sqrt(scale.variance)),
                         static_cast<int>(peak.cars)};
}

/// Whether most of what is detected under the assumption that scores highest looks like no vehicle.
bool isAmidRelief(const std::vector<double>& scores, const std::vector<ScaleOutcome>& outcomes) {
    const auto highest = std::max_element(scores.begin(), scores.end());
    return outcomes[static_cast<std::size_t>(highest - scores.begin())].alike() < kMostlyRelief;
}

}  // namespace

double assumedGsd(int i) {
    return kFinest * std::pow(kStep, i);
}

double ScaleOutcome::alike() const {
    return detections > 0 ? looks / detections : 0;
}

double ScaleOutcome::darkness() const {
    return detections > 0 ? in_dark / detections : 0;
}

double ScaleOutcome::score() const {
    return decision * std::pow(alike(), kAlikePower) * std::pow((cars + 1) / (tracks + 2), kCarsPower);
}

double ScaleOutcome::scoreAmidRelief() const {
    const double sureness = looks > 0 ? decision / looks : 0;
    return sureness * whole_cars * std::pow((whole_cars + 1) / (whole_tracks + 2), kWholeCarsPower);
}

bool ScaleOutcome::showsTraffic() const {
    return looks >= kFewestLooks && cars >= 1;
}

ScaleOutcome operator+(const ScaleOutcome& a, const ScaleOutcome& b) {
    ScaleOutcome both = a;
    both.detections += b.detections;
    both.looks += b.looks;
    both.decision += b.decision;
    both.tracks += b.tracks;
    both.cars += b.cars;
    both.whole_tracks += b.whole_tracks;
    both.whole_cars += b.whole_cars;
    both.in_dark += b.in_dark;
    both.car_speeds_m_s.insert(both.car_speeds_m_s.end(), b.car_speeds_m_s.begin(), b.car_speeds_m_s.end());
    return both;
}

bool isCarSized(double length_m, double width_m) {
    return length_m > 3.6 && length_m < 6.6 && width_m > 1.5 && width_m < 3.8;
}

void ScaleScores::add(const std::vector<ScaleOutcome>& outcomes) {
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        all_[i] += outcomes[i].score();
        amid_relief_[i] += outcomes[i].scoreAmidRelief();
    }
}

std::optional<ScaleEstimate> ScaleScores::estimate(const std::vector<ScaleOutcome>& sums) const {
    const auto usual = estimateBy(all_, sums);
    if (!usual || !isAmidRelief(amid_relief_, sums)) return usual;
    const auto coarser = estimateBy(amid_relief_, sums);
    return coarser && coarser->gsd_m_per_px > kMuchCoarser * usual->gsd_m_per_px ? coarser : usual;
}

std::optional<ScaleEstimate> estimateOfScale(const std::vector<ScaleOutcome>& outcomes) {
    ScaleScores scores;
    scores.add(outcomes);
    return scores.estimate(outcomes);
}

void LooksTogether::add(const std::vector<ScaleOutcome>& outcomes) {
    if (!estimateOfScale(outcomes)) return;
    for (std::size_t i = 0; i < outcomes.size(); ++i) sums_[i] = sums_[i] + outcomes[i];
    scores_.add(outcomes);
    if (const auto estimate = scores_.estimate(sums_)) estimate_ = estimate;
}

bool LooksTogether::suffice() const {
    return estimate_ && estimate_->vehicles >= kPlenty;
}

std::optional<std::size_t> bestOfViews(const std::vector<ScaleOutcome>& outcomes) {
    std::optional<std::size_t> best;
    double most = 0;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        const ScaleOutcome& outcome = outcomes[i];
        if (!outcome.showsTraffic() || outcome.cars < kMostlyCars * outcome.tracks) continue;
        if (outcome.score() <= most) continue;
        most = outcome.score();
        best = i;
    }
    return best;
}

}  // namespace eyrie
