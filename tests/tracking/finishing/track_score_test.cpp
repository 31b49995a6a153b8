#include "tracking/finishing/track_score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tracking/finishing/track_finishing.h"

namespace eyrie::track_score_test {
namespace {

/// A vehicle as most are seen from a camera that flies on.
TrackEvidence vehicle() {
    TrackEvidence evidence;
    evidence.detected = 0.9;
    evidence.looked_alike = 0.3;
    evidence.decision = 5;
    evidence.life_s = 3;
    evidence.flow_px = 1.5;
    evidence.flow_ratio = 1.2;
    evidence.alignment = 0.1;
    return evidence;
}

TrackEvidence with(double TrackEvidence::*what, double value, TrackEvidence evidence = vehicle()) {
    evidence.*what = value;
    return evidence;
}

const SceneScale kScale{.gsd_m_per_px = 0.2, .frame_rate_hz = 25, .gsd_known = true};
constexpr int kFrames = 60;

/// Under a camera whose ground goes 3 px/frame to the right: a car that overtakes it, and a cloud that hardly moves in
/// the picture and is found in every third frame.
struct CarAndCloud {
    std::vector<FrameMotionSummary> motion;
    std::vector<TimedState> states;
    std::vector<TimedDrop> dropped;

    CarAndCloud() {
        for (FrameIndex frame = 0; frame < kFrames; ++frame) {
            FrameMotionSummary summary;
            summary.frame = frame;
            summary.image_size = {1000, 600};
            summary.registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
            summary.registration.current_from_previous.matrix(0, 2) = frame == 0 ? 0 : 3;
            motion.push_back(summary);
            states.emplace_back(frame, stateOf(1, {200.0 + 7 * frame, 300}, {4, 0}, StateOrigin::detected));
            states.emplace_back(frame, stateOf(2, {500.0 + 0.2 * frame, 40}, {-2.8, 0},
                                               frame % 3 == 0 ? StateOrigin::detected : StateOrigin::reconstructed));
        }
    }
    static TrackState stateOf(TrackId id, cv::Point2d centre, cv::Point2d velocity, StateOrigin origin) {
        TrackState state;
        state.id = id;
        state.box = {centre, 20, 10, 0};
        state.velocity = velocity;
        state.status = TrackStatus::confirmed;
        state.origin = origin;
        state.score = 0.5;
        return state;
    }
    static std::vector<ClassifiedBox> car(FrameIndex frame) {
        return {{{{200.0 + 7 * frame, 300}, 22, 11, 0}, true, 6}, {{{500.0 + 0.2 * frame, 40}, 20, 10, 0}, false, -3}};
    }

    std::vector<TimedState> finished(const ClassifiedAt& classified_at, const FinishingOptions& options = {}) {
        dropped.clear();
        return finishTracks(states, motion, options, kScale, {{}, classified_at}, &dropped);
    }
};

bool has(const std::vector<TimedState>& states, TrackId id) {
    return std::any_of(states.begin(), states.end(), [&](const TimedState& state) { return state.second.id == id; });
}

}  // namespace

TEST(TrackScore, IsAProbabilityThatIsHighForAVehicle) {
    EXPECT_GT(probabilityOf(vehicle()), 0.9);
    EXPECT_LE(probabilityOf(vehicle()), 1);
    TrackEvidence nothing;
    EXPECT_GE(probabilityOf(nothing), 0);
    EXPECT_LT(probabilityOf(nothing), 0.1);
}

TEST(TrackScore, RisesWithWhatSpeaksForAVehicle) {
    EXPECT_GT(probabilityOf(vehicle()), probabilityOf(with(&TrackEvidence::detected, 0.4)));
    EXPECT_GT(probabilityOf(vehicle()), probabilityOf(with(&TrackEvidence::decision, 0)));
    EXPECT_GT(probabilityOf(with(&TrackEvidence::decision, 8)), probabilityOf(vehicle()));
    EXPECT_GT(probabilityOf(vehicle()), probabilityOf(with(&TrackEvidence::life_s, 0.3)));
    EXPECT_GT(probabilityOf(vehicle()), probabilityOf(with(&TrackEvidence::flow_ratio, 0.3)));
}

TEST(TrackScore, DoubtsWhatSticksToTheImageUnlessItLookedLikeAVehicle) {
    TrackEvidence sticks = vehicle();
    sticks.decision = -3;
    sticks.detected = 0.5;
    sticks.flow_px = 5;
    sticks.flow_ratio = 1;
    sticks.alignment = -1;
    EXPECT_LT(probabilityOf(sticks), 0.25);
    EXPECT_GT(probabilityOf(with(&TrackEvidence::decision, 6, sticks)), 0.5) << "a car that the camera follows";
    EXPECT_GT(probabilityOf(with(&TrackEvidence::alignment, 0, sticks)), probabilityOf(sticks));
    const TrackEvidence hovering = with(&TrackEvidence::flow_px, 0, sticks);
    EXPECT_EQ(probabilityOf(with(&TrackEvidence::alignment, 1, hovering)), probabilityOf(hovering))
        << "a camera that hovers tells nothing";
}

TEST(TrackScore, BeyondALimitFasterTellsNoMore) {
    const auto flow = [](double value) { return probabilityOf(with(&TrackEvidence::flow_px, value)); };
    EXPECT_EQ(flow(4.1), flow(9));
    EXPECT_NE(flow(3.9), flow(4));
    const auto ratio = [](double value) { return probabilityOf(with(&TrackEvidence::flow_ratio, value)); };
    EXPECT_EQ(ratio(1.51), ratio(3));
    EXPECT_LT(ratio(1.45), ratio(1.5));
}

TEST(TrackScore, AgainstTheFlowOnlyWhatCouldStickOrLieALittleBelowIsDoubted) {
    const auto doubted = [](double ratio, double alignment = -1) {
        const TrackEvidence moves = with(&TrackEvidence::flow_ratio, ratio);
        return probabilityOf(with(&TrackEvidence::alignment, alignment, moves)) <
               probabilityOf(with(&TrackEvidence::alignment, 0, moves)) - 1e-6;
    };
    EXPECT_TRUE(doubted(1));
    EXPECT_TRUE(doubted(0.75)) << "a quarter of the flow through the picture";
    EXPECT_TRUE(doubted(1.25));
    EXPECT_FALSE(doubted(0.65));
    EXPECT_FALSE(doubted(1.35));
    EXPECT_FALSE(doubted(1, -0.95)) << "it moves aside by .31 of the flow";
    EXPECT_TRUE(doubted(1, -0.97));
    EXPECT_TRUE(doubted(0.24)) << "a fifth of the flight's height below the ground";
    EXPECT_FALSE(doubted(0.26));
}

TEST(TrackScore, DoesNotDependOnHowLongTheVehicleStands) {
    CarAndCloud scene;
    TrackPath drives{1, {}};
    for (const auto& [frame, state] : scene.states) {
        if (state.id == 1) drives.states.emplace_back(frame, PathState(state));
    }
    TrackPath stands = drives;
    for (FrameIndex frame = kFrames; frame < 10 * kFrames; ++frame) {
        FrameMotionSummary summary = scene.motion.back();
        summary.frame = frame;
        scene.motion.push_back(summary);
        TrackState state =
            CarAndCloud::stateOf(1, {200.0 + 7 * 59 + 3 * (frame - 59), 300}, {0, 0}, StateOrigin::standing);
        stands.states.emplace_back(frame, PathState(state));
    }
    const GroundMotion ground(scene.motion);
    const TrackLooks seen{20, 10, 40};
    const TrackEvidence before = evidenceOf(drives, seen, ground, kScale);
    const TrackEvidence after = evidenceOf(stands, seen, ground, kScale);
    EXPECT_EQ(after.detected, before.detected);
    EXPECT_EQ(after.life_s, before.life_s);
    EXPECT_NEAR(after.flow_ratio, before.flow_ratio, 0.05);
    EXPECT_NEAR(probabilityOf(after), probabilityOf(before), 0.01);
}

TEST(TrackScore, DropsTheCloudAndKeepsTheCar) {
    CarAndCloud scene;
    const auto result = scene.finished(CarAndCloud::car);
    EXPECT_TRUE(has(result, 1));
    EXPECT_FALSE(has(result, 2));
    ASSERT_FALSE(scene.dropped.empty());
    for (const auto& [frame, state] : scene.dropped) {
        EXPECT_EQ(state.id, 2);
        EXPECT_EQ(state.why, TrackDrop::unlikely);
    }
}

TEST(TrackScore, IsTheSumOfWhatSpeaksForATrackAndAgainstIt) {
    TrackEvidence evidence = vehicle();
    for (const double detected : {0.2, 0.6, 1.0}) {
        for (const double decision : {-4.0, 8.0}) {
            evidence.detected = detected;
            evidence.decision = decision;
            EXPECT_NEAR(1 / (1 + std::exp(-partsOf(evidence).sum())), probabilityOf(evidence), 1e-12);
            EXPECT_EQ(partsOf(evidence).looks < 0, decision < 0);
            EXPECT_EQ(partsOf(evidence).detected > 0.1, detected > 0.6);
        }
    }
}

/// By the weights that were learned, written here once more: who learns them anew changes both.
TEST(TrackScore, IsTheLogisticSumOfWhatWasLearned) {
    TrackEvidence evidence;
    evidence.detected = 0.8;
    evidence.decision = 3;
    evidence.life_s = 1.9;
    evidence.flow_px = 2;
    evidence.flow_ratio = 0.2;
    evidence.alignment = -0.5;  // half of a thing that lies below the ground
    const double flow = std::log(3.0);
    const double alike =
        -3.877 + 4.994 * 0.8 + 0.643 * std::log(2.0) + flow * (-0.770 - 0.5 + 1.360 * 0.2 - 1.036 * 0.2);
    const auto logistic = [](double sum) { return 1 / (1 + std::exp(-sum)); };
    EXPECT_NEAR(probabilityOf(evidence), logistic(alike + 0.429 * 3), 1e-9);
    EXPECT_NEAR(probabilityOf(with(&TrackEvidence::decision, std::nan(""), evidence)), logistic(alike + 0.429 * 1.8),
                1e-9)
        << "nobody looked: as if it were no sign either way";
    const ScoreParts parts = partsOf(evidence);
    EXPECT_NEAR(parts.looks, -3.877 + 4.994 * 0.6 + 0.429 * 3, 1e-9);
    EXPECT_NEAR(parts.detected, 4.994 * 0.2 - 1.036 * flow * 0.2, 1e-9);
    EXPECT_NEAR(parts.life, 0.643 * std::log(2.0), 1e-9);
    EXPECT_NEAR(parts.motion, flow * (-0.770 - 0.5 + 1.360 * 0.2), 1e-9);
    // It moves aside by .224 of the flow through the picture: a quarter of what sticks.
    evidence.flow_ratio = 1;
    evidence.alignment = -0.975;
    const double sticks = 1 - std::sqrt(0.05) / 0.3;
    EXPECT_NEAR(partsOf(evidence).motion, flow * (-0.770 - sticks + 1.360), 1e-9);
}

TEST(TrackScore, EvidenceIsCountedInFramesThatItDoesNotStand) {
    const TrackEvidence evidence = evidenceOf({50, 40, {10, 4, 12}}, FlowComparison{0.7, 0.9, -0.2, 1.5}, 25);
    EXPECT_DOUBLE_EQ(evidence.detected, 0.8);
    EXPECT_DOUBLE_EQ(evidence.looked_alike, 0.25);
    EXPECT_DOUBLE_EQ(evidence.decision, 3);
    EXPECT_DOUBLE_EQ(evidence.life_s, 2);
    EXPECT_DOUBLE_EQ(evidence.flow_ratio, 0.7);
    EXPECT_DOUBLE_EQ(evidence.alignment, -0.2);
    EXPECT_DOUBLE_EQ(evidence.flow_px, 1.5);
    EXPECT_DOUBLE_EQ(evidence.score, probabilityOf(evidence));
    const TrackEvidence nothing = evidenceOf({0, 0, {}}, std::nullopt, 25);
    EXPECT_DOUBLE_EQ(nothing.life_s, 0.04) << "a frame at least";
    EXPECT_EQ(nothing.detected, 0);
    EXPECT_EQ(nothing.flow_px, 0);
    EXPECT_DOUBLE_EQ(evidenceOf({1, 1, {1, 0, 0}}, std::nullopt, 25).looked_alike, 1);
}

TEST(TrackScore, TellsWhatSpokeForEachTrackAndKeepsTheDoubtfulOnes) {
    CarAndCloud scene;
    const StatesOfRun states = [&](const StateVisitor& visitor) {
        for (const auto& [frame, state] : scene.states) visitor(frame, state);
    };
    const FinishedTracks finished =
        finishRun(states, GroundMotion(scene.motion), {}, kScale, {{}, ClassifiedAt(CarAndCloud::car)});
    ASSERT_EQ(finished.doubtful.size(), 1U);
    EXPECT_EQ(finished.doubtful.front().id, 2);
    EXPECT_EQ(finished.evidence.size(), 2U);
    EXPECT_GT(finished.evidence.at(1).score, 0.9);
    EXPECT_GT(finished.evidence.at(1).looked_alike, 0.9);
    EXPECT_EQ(finished.evidence.at(1).decision, 6);
    EXPECT_EQ(finished.evidence.at(2).decision, -3);
    EXPECT_LT(finished.evidence.at(2).score, FinishingOptions().min_score);
    EXPECT_LT(finished.evidence.at(2).alignment, -0.9);
    int doubtful = 0;
    finished.visitDoubtful([&](FrameIndex, const TrackState& state) {
        ++doubtful;
        EXPECT_EQ(state.id, 2);
        EXPECT_NEAR(state.score, finished.evidence.at(2).score, 1e-6);
    });
    EXPECT_GT(doubtful, 50);
}

TEST(TrackScore, IsTheSameInAllStatesOfATrack) {
    CarAndCloud scene;
    FinishingOptions options;
    options.min_score = 0;
    const auto result = scene.finished(CarAndCloud::car, options);
    EXPECT_TRUE(has(result, 2)) << "0 drops nothing";
    double of_car = -1;
    double of_cloud = -1;
    for (const auto& [frame, state] : result) {
        double& known = state.id == 1 ? of_car : of_cloud;
        if (known < 0) known = state.score;
        EXPECT_EQ(state.score, known);
    }
    EXPECT_GT(of_car, 0.9);
    EXPECT_LT(of_cloud, 0.25);
}

TEST(TrackScore, NeedsAClassifier) {
    CarAndCloud scene;
    const auto result = scene.finished({});
    EXPECT_TRUE(has(result, 2));
    for (const auto& [frame, state] : result) EXPECT_EQ(state.score, 0.5) << "as the tracker left it";
}

}  // namespace eyrie::track_score_test
