#include <gtest/gtest.h>

#include <map>

#include "tracking/finishing/track_finishing.h"
#include "tracking/frame_summaries.h"

namespace eyrie::standstill_extension_test {
namespace {

const SceneScale kScale{0.3, 25, true};
constexpr int kFrames = 200;
constexpr int kStart = 60;  ///< frame in which the vehicle starts
constexpr int kFound = 90;  ///< frame in which the tracker found it

/// A car that stands, then starts with a constant acceleration, under a camera that pans.
struct Starter {
    double acceleration = 0.006;  ///< px/frame², 1.1 m/s²
    double initial_speed = 0;     ///< px/frame it had all the time before

    OrientedBox at(int frame) const {
        const double moving = std::max(0, frame - kStart);
        const double x = 100 + initial_speed * frame + acceleration * moving * moving / 2;
        return {{x - 0.3 * frame, 150}, 15, 6, 0};
    }
    double speedAt(int frame) const { return initial_speed + acceleration * std::max(0, frame - kStart); }

    std::map<FrameIndex, TrackState> finished(const FinishingOptions& options = {},
                                              const std::vector<TimedState>& others = {}) const {
        std::vector<TimedState> states = others;
        std::vector<FrameMotionSummary> motion;
        for (int frame = 0; frame < kFrames; ++frame) {
            motion.push_back(test::summaryOfFrame(frame, -0.3));
            if (frame < kFound) continue;
            TrackState state;
            state.id = 1;
            state.box = at(frame);
            state.velocity = {speedAt(frame), 0};
            state.status = TrackStatus::confirmed;
            states.emplace_back(frame, state);
        }
        std::map<FrameIndex, TrackState> result;
        for (const auto& [frame, state] : finishTracks(states, motion, options, kScale)) {
            if (state.id == 1) result[frame] = state;
        }
        return result;
    }
};

TEST(StandstillExtension, ATrackGoesBackToWhereTheVehicleStood) {
    const Starter starter;
    const auto states = starter.finished();
    EXPECT_EQ(states.begin()->first, 0) << "four seconds are 100 frames";
    for (const auto& [frame, state] : states) EXPECT_GT(overlap(state.box, starter.at(frame)), 0.9) << frame;
    EXPECT_EQ(states.at(70).origin, StateOrigin::predicted);
    EXPECT_NEAR(states.at(75).velocity.x, starter.speedAt(75), 0.03);
    EXPECT_NEAR(states.at(30).velocity.x, 0, 1e-9);
}

TEST(StandstillExtension, StandsForTheTimeAllowedOnly) {
    FinishingOptions options;
    options.from_rest_s = 2;
    EXPECT_EQ(Starter{}.finished(options).begin()->first, kFound - 50);
    options.from_rest_s = 0;
    EXPECT_GE(Starter{}.finished(options).begin()->first, kFound - 5) << "extend_back alone";
}

TEST(StandstillExtension, NotWhatDrivesEvenlyOrBrakesOrIsFastAlready) {
    Starter even;
    even.acceleration = 0;
    even.initial_speed = 0.3;
    EXPECT_GE(even.finished().begin()->first, kFound - 5);
    Starter braking;
    braking.acceleration = -0.004;
    braking.initial_speed = 0.8;
    EXPECT_GE(braking.finished().begin()->first, kFound - 5);
    Starter fast;
    fast.acceleration = 0.02;  // 0.6 px/frame, 4.5 m/s, when it is found
    EXPECT_GE(fast.finished().begin()->first, kFound - 5);
}

TEST(StandstillExtension, EndsWhereAnotherTrackStood) {
    const Starter starter;
    std::vector<TimedState> other;
    for (int frame = 0; frame < 40; ++frame) {
        TrackState state;
        state.id = 2;
        state.box = starter.at(frame);
        state.box.centre.x += 4;
        state.status = TrackStatus::confirmed;
        other.emplace_back(frame, state);
    }
    FinishingOptions options;
    options.join_gap_s = 0;
    EXPECT_EQ(starter.finished(options, other).begin()->first, 40);
}

}  // namespace
}  // namespace eyrie::standstill_extension_test
