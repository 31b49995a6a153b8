#include <gtest/gtest.h>

#include <map>

#include "tracking/finishing/track_finishing.h"
#include "tracking/tracked_scene.h"

namespace eyrie::track_tracing_test {
namespace {

using test::MovingScene;

constexpr int kFrames = 90;

/// A car under a turning, zooming camera that the tracker found at frame 50 only.
class TraceBack : public testing::Test {
 protected:
    TraceBack() {
        scene_.objects = {{{250, 180}, {1.5, 0.8}, 20, 10, 0}};
        scene_.camera.turn = [](int frame) { return 0.01 * frame; };
        scene_.camera.zoom = [](int frame) { return 1 + 0.003 * frame; };
        scene_.camera.shift = [](int frame) { return cv::Point2d(-1.0 * frame, 0.3 * frame); };
    }

    /// States of the finished track by frame. `has_vectors`: of which frames; their velocities are changed by a factor.
    std::map<FrameIndex, TrackState> finished(const std::function<bool(int)>& has_vectors,
                                              const FinishingOptions& options = {}, cv::Point2f factor = {1, 1}) const {
        std::vector<TimedState> states;
        std::vector<FrameMotionSummary> summaries;
        VectorsByFrame vectors;
        for (int frame = 0; frame < kFrames; ++frame) {
            FrameMotion motion = scene_.motion(frame);
            summaries.push_back({frame, motion.registration, motion.image_size});
            for (MotionVector& vector : motion.motion_vectors)
                vector.velocity = {factor.x * vector.velocity.x, factor.y * vector.velocity.y};
            if (has_vectors(frame)) vectors[frame] = motion.motion_vectors;
            if (frame < 50) continue;
            TrackState state;
            state.id = 1;
            state.box = scene_.box(0, frame);
            state.velocity = scene_.velocity(0, frame);
            state.status = TrackStatus::confirmed;
            states.emplace_back(frame, state);
        }
        std::map<FrameIndex, TrackState> result;
        for (const auto& [frame, state] : finishTracks(states, summaries, options, scene_.scale, vectorsIn(vectors)))
            result[frame] = state;
        return result;
    }

    MovingScene scene_;
};

TEST_F(TraceBack, FollowsTheMotionVectorsOverTheGround) {
    const auto states = finished([](int) { return true; });
    ASSERT_LE(states.begin()->first, 30) << "by half of the track's life";
    for (const auto& [frame, state] : states)
        EXPECT_GT(overlap(state.box, scene_.box(0, frame)), 0.9) << "frame " << frame;
    EXPECT_EQ(states.at(40).origin, StateOrigin::reconstructed);
}

TEST_F(TraceBack, EndsWhereTheVectorsBegin) {
    const auto states = finished([](int frame) { return frame >= 40; });
    // Five frames more, in which vectors are too young; see finishing.extend_back.
    EXPECT_EQ(states.begin()->first, 35);
    EXPECT_EQ(states.begin()->second.origin, StateOrigin::predicted);
}

TEST_F(TraceBack, BridgesAShortGapButNotALongOne) {
    EXPECT_LE(finished([](int frame) { return frame < 36 || frame > 40; }).begin()->first, 30);
    EXPECT_EQ(finished([](int frame) { return frame < 30 || frame > 45; }).begin()->first, 41);
}

TEST_F(TraceBack, NeedsVectorsThatMoveAlike) {
    FinishingOptions options;
    options.extend_back = 0;
    const auto states = finished([](int) { return true; }, options, {-1, -1});
    EXPECT_EQ(states.begin()->first, 50) << "oncoming traffic is no support";
}

TEST_F(TraceBack, CanBeSwitchedOff) {
    FinishingOptions options;
    options.trace_back_s = 0;
    EXPECT_EQ(finished([](int) { return true; }, options).begin()->first, 45);
}

/// A car and a second, shorter-lived track beside it; how many tracks are left.
std::size_t tracksLeft(cv::Point2d offset, cv::Point2d more_velocity) {
    MovingScene scene;
    scene.objects = {{{100, 100}, {2, 0}, 20, 9, 0},
                     {cv::Point2d(100, 100) + offset, cv::Point2d(2, 0) + more_velocity, 16, 9, 100}};
    std::vector<TimedState> states;
    std::vector<FrameMotionSummary> summaries;
    for (int frame = 0; frame < 60; ++frame) {
        const FrameMotion motion = scene.motion(frame);
        summaries.push_back({frame, motion.registration, motion.image_size});
        for (std::size_t i = 0; i < 2; ++i) {
            if (i == 1 && (frame < 10 || frame > 45)) continue;
            TrackState state;
            state.id = static_cast<TrackId>(i) + 1;
            state.box = scene.box(i, frame);
            state.velocity = scene.velocity(i, frame);
            state.status = TrackStatus::confirmed;
            states.emplace_back(frame, state);
        }
    }
    std::map<TrackId, int> ids;
    for (const auto& [frame, state] : finishTracks(states, summaries, {}, scene.scale)) ++ids[state.id];
    return ids.size();
}

TEST(FixedTracks, APartThatKeepsItsPlaceGivesWayAndAPassingCarDoesNot) {
    EXPECT_EQ(tracksLeft({-4, 6}, {0, 0}), 1U) << "its shadow: a third of it lies on the car, as if fixed";
    EXPECT_EQ(tracksLeft({-14, 6}, {0.4, 0}), 2U) << "passes with the same overlap";
    EXPECT_EQ(tracksLeft({0, 11}, {0, 0}), 2U) << "side by side at one speed, not touching";
}

}  // namespace
}  // namespace eyrie::track_tracing_test
