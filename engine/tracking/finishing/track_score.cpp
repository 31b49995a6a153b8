#include "tracking/finishing/track_score.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tracking/finishing/flow_comparison.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

constexpr double kMostFlow = 4;     ///< px/frame; a faster camera tells no more
constexpr double kMostRatio = 1.5;  ///< the same of own motion
constexpr double kSticksRatio =
    1.15;                            ///< what is infinitely far below the ground's plane, or in the lens, goes so fast
constexpr double kUsualShare = 0.6;  ///< of states detected
constexpr double kLifeOffset = 0.1;  ///< s

constexpr std::size_t kFigures = 10;
/// As tests/learn_track_score prints them.
constexpr std::array<double, kFigures> kWeights{-3.424, 4.551,  0.907, 2.522, 0.575,
                                                -2.072, -1.055, 1.214, 1.688, -1.178};

std::array<double, kFigures> figuresOf(const TrackEvidence& e) {
    const double flow = std::log1p(std::min(e.flow_px, kMostFlow));
    const double ever = e.looked_alike > 0 ? 1 : 0;
    const double against = e.flow_ratio < kSticksRatio ? std::clamp(-e.alignment, 0.0, 1.0) : 0;
    return {1,
            e.detected,
            ever,
            std::sqrt(e.looked_alike),
            std::log(e.life_s + kLifeOffset),
            flow,
            flow * against,
            flow * std::min(e.flow_ratio, kMostRatio),
            flow * ever,
            flow * (e.detected - kUsualShare)};
}

}  // namespace

TrackEvidence evidenceOf(const TrackPath& path, int looks, const GroundMotion& ground, const SceneScale& scale) {
    TrackEvidence evidence;
    const int detected = path.statesOf(StateOrigin::detected);
    const auto states = std::max(1.0, static_cast<double>(path.states.size()) - path.statesOf(StateOrigin::standing));
    evidence.detected = detected / states;
    evidence.looked_alike = static_cast<double>(looks) / std::max(1, detected);
    evidence.life_s = states / scale.frame_rate_hz;
    if (const auto compared = comparedWithFlow(path, ground)) {
        evidence.flow_px = compared->flow;
        evidence.flow_ratio = compared->ratio;
        evidence.alignment = compared->alignment;
    }
    return evidence;
}

double probabilityOf(const TrackEvidence& evidence) {
    const auto figures = figuresOf(evidence);
    double sum = 0;
    for (std::size_t i = 0; i < kFigures; ++i) sum += kWeights[i] * figures[i];
    return 1 / (1 + std::exp(-sum));
}

void scoreTracks(std::vector<TrackPath>& paths, const GroundMotion& ground, const VehicleLooks& looks, double min_score,
                 const SceneScale& scale, DropList& dropped) {
    std::erase_if(paths, [&](TrackPath& path) {
        const auto found = looks.find(path.id);
        const int count = found == looks.end() ? 0 : found->second;
        const double score = probabilityOf(evidenceOf(path, count, ground, scale));
        for (auto& [frame, state] : path.states) state.score = static_cast<float>(score);
        if (score >= min_score) return false;
        drop(path, TrackDrop::unlikely, dropped);
        return true;
    });
}

}  // namespace eyrie
