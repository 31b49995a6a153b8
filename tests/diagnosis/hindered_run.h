#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chain/chain.h"
#include "chain/recording/run_recorder.h"
#include "diagnosis/diagnoser.h"
#include "explain/place_explainer.h"
#include "support/moving_scene.h"
#include "tracking/finishing/track_finishing.h"

namespace eyrie::test {

/// What the list of errors tells of a vehicle of which no result is there in a frame.
inline DiagnosedError missOf(DiagnosisSource source, FrameIndex frame, const OrientedBox& place) {
    BoxRecord vehicle;
    vehicle.frame = frame;
    vehicle.id = 1;
    vehicle.box = place;
    vehicle.object_class = "car";
    const BoxesByFrame truth{{frame, {vehicle}}};
    const EvaluationOptions evaluation;
    const BoxesByFrame found;
    const EvaluationInput input = prepareEvaluation(truth, found, evaluation);
    const auto matches = matchFrames(input, evaluation);
    auto errors = Diagnoser(std::move(source))
                      .diagnose(listErrors(truth, found, input, matches, evaluation),
                                {truth, found, input, matches, evaluation}, {});
    EXPECT_EQ(errors.size(), 1U);
    return errors.empty() ? DiagnosedError{} : errors.front();
}

/// What was compared, as the list of errors words it, without the parameter and its first letter: a sentence may begin
/// with it.
inline std::string comparisonIn(const DiagnosedError& error) {
    const std::string text = error.text.substr(0, error.text.rfind(" ("));
    EXPECT_GT(text.size(), 1U);
    return text.empty() ? text : text.substr(1);
}

/// A run over a small drawn scene, kept in memory, with parameters that keep its first vehicle from being found.
class HinderedRun {
 public:
    static constexpr FrameIndex kFrame = 30;

    explicit HinderedRun(const ChainOptions& options)
        : source_(scene_), options_(options), scale_(sceneScale(source_.info(), 0.2)) {
        Chain chain(options, scale_);
        for (FrameIndex f = 0; f <= kFrame; ++f) results_[f] = chain.next(source_.read(f, false));
    }
    /// As a run does at its end. A classifier is taken to have recognised nothing.
    void finish() {
        std::vector<TimedState> states;
        std::vector<FrameMotionSummary> motion;
        for (auto& [frame, result] : results_) {
            for (const TrackState& state : result.tracks) states.emplace_back(frame, state);
            motion.push_back({frame, result.motion.registration, result.motion.image_size});
            result.tracks.clear();
        }
        const FoundInFrames found{[this](FrameIndex frame) { return results_.at(frame).motion.motion_vectors; },
                                  [](FrameIndex) { return std::vector<ClassifiedBox>{}; }};
        std::vector<TimedDrop> dropped;
        for (const auto& [frame, state] : finishTracks(states, motion, options_.finishing, scale_, found, &dropped))
            results_[frame].tracks.push_back(state);
        for (const auto& [frame, state] : dropped) results_[frame].dropped.push_back(state);
    }

    OrientedBox place() const { return placeAt(scene_.vehicleAt(scene_.vehicles.front(), kFrame), scale_); }
    const FrameResult& result() const { return results_.at(kFrame); }
    /// As the stages and the explanations of a stored run see it.
    ReplaySource replaySource() {
        ReplaySource replay;
        replay.options = options_;
        replay.scale = scale_;
        replay.pixels = [this](FrameIndex frame) { return source_.read(frame, false); };
        replay.result_of = [this](FrameIndex frame) { return resultOf(frame); };
        replay.motion_of = [this](FrameIndex frame) -> std::optional<FrameMotion> { return resultOf(frame)->motion; };
        return replay;
    }
    Explanation explanation() { return PlaceExplainer(replaySource()).explain(kFrame, place(), {}).value(); }
    /// Of the vehicle that nothing was found of.
    DiagnosedError diagnosis() {
        DiagnosisSource source;
        source.options = options_;
        source.scale = scale_;
        source.frame_result = [this](FrameIndex frame) { return resultOf(frame); };
        return missOf(std::move(source), kFrame, place());
    }

 private:
    std::optional<FrameResult> resultOf(FrameIndex frame) const { return results_.at(frame); }

    MovingScene scene_;
    MemorySource source_;
    ChainOptions options_;
    SceneScale scale_;
    std::map<FrameIndex, FrameResult> results_;
};

}  // namespace eyrie::test
