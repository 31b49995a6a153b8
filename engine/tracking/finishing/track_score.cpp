#include "tracking/finishing/track_score.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/flow_limits.h"
#include "tracking/finishing/flow_comparison.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

constexpr double kUsualShare = 0.6;  ///< of states detected
constexpr double kLifeOffset = 0.1;  ///< s

constexpr double kLeastInPicture = 0.3;  ///< of the flow: what moves that much through the picture does not stick to it
constexpr double kDeepestRatio = 0.25;   ///< of own motion to the flow: a fifth of the flight's height below the ground

constexpr double kUnknownDecision = 1.8;  ///< tells nothing

constexpr std::size_t kFigures = 8;
/// As tests/learn_track_score prints them.
constexpr std::array<double, kFigures> kWeights{-3.877, 4.994, 0.429, 0.643, -0.770, -1.000, 1.360, -1.036};

/// How far a thing that seems to move against the ground's flow may do so without moving, 0 … 1: it keeps its place in
/// the picture, as dirt on the lens does, or lies a little below the ground's plane.
double stillAgainstFlow(const TrackEvidence& e) {
    const double in_picture = std::sqrt(std::max(0.0, 1 + e.flow_ratio * (e.flow_ratio + 2 * e.alignment)));
    const double sticks = std::max(0.0, 1 - in_picture / kLeastInPicture);
    const double below = e.flow_ratio < kDeepestRatio ? std::clamp(-e.alignment, 0.0, 1.0) : 0;
    return std::max(sticks, below);
}

std::array<double, kFigures> figuresOf(const TrackEvidence& e) {
    const double flow = std::log1p(std::min(e.flow_px, kMostFlow));
    const double decision = std::isnan(e.decision) ? kUnknownDecision : e.decision;
    return {1,
            e.detected,
            decision,
            std::log(e.life_s + kLifeOffset),
            flow,
            flow * stillAgainstFlow(e),
            flow * std::min(e.flow_ratio, kMostFlowRatio),
            flow * (e.detected - kUsualShare)};
}

}  // namespace

TrackEvidence evidenceOf(const TrackTally& tally, const std::optional<FlowComparison>& motion, double frame_rate_hz) {
    TrackEvidence evidence;
    const double states = std::max(1, tally.states);
    evidence.detected = tally.detected / states;
    evidence.looked_alike = static_cast<double>(tally.looks.alike) / std::max(1, tally.detected);
    evidence.decision = tally.looks.decision();
    evidence.life_s = states / frame_rate_hz;
    if (motion) {
        evidence.flow_px = motion->flow;
        evidence.flow_ratio = motion->ratio;
        evidence.alignment = motion->alignment;
    }
    evidence.score = probabilityOf(evidence);
    return evidence;
}

TrackEvidence evidenceOf(const TrackPath& path, const TrackLooks& looks, const GroundMotion& ground,
                         const SceneScale& scale) {
    const int states = static_cast<int>(path.states.size()) - path.statesOf(StateOrigin::standing);
    return evidenceOf({states, path.statesOf(StateOrigin::detected), looks}, comparedWithFlow(path, ground),
                      scale.frame_rate_hz);
}

double probabilityOf(const TrackEvidence& evidence) {
    const auto figures = figuresOf(evidence);
    double sum = 0;
    for (std::size_t i = 0; i < kFigures; ++i) sum += kWeights[i] * figures[i];
    return 1 / (1 + std::exp(-sum));
}

ScoreParts partsOf(const TrackEvidence& evidence) {
    const auto figures = figuresOf(evidence);
    const auto part = [&](std::size_t i) { return kWeights[i] * figures[i]; };
    const double usual = kWeights[1] * kUsualShare;
    ScoreParts parts;
    parts.detected = part(1) - usual + part(7);
    parts.looks = part(0) + usual + part(2);
    parts.life = part(3);
    parts.motion = part(4) + part(5) + part(6);
    return parts;
}

void scoreTracks(std::vector<TrackPath>& paths, const GroundMotion& ground, const VehicleLooks& looks, double min_score,
                 const SceneScale& scale, FinishedTracks& finished) {
    const auto scored = [&](TrackPath& path) {
        const auto found = looks.find(path.id);
        const TrackEvidence evidence =
            evidenceOf(path, found == looks.end() ? TrackLooks{} : found->second, ground, scale);
        for (auto& [frame, state] : path.states) state.score = static_cast<float>(evidence.score);
        finished.evidence[path.id] = evidence;
        return evidence.score;
    };
    for (DroppedPath& stands : finished.dropped) {
        if (stands.why == TrackDrop::could_stand) scored(stands.path);
    }
    std::erase_if(paths, [&](TrackPath& path) {
        if (scored(path) >= min_score) return false;
        finished.doubtful.push_back(path);
        drop(path, TrackDrop::unlikely, finished.dropped);
        return true;
    });
}

}  // namespace eyrie
