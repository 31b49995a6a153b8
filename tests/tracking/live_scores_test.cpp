#include "tracking/live_scores.h"

#include <gtest/gtest.h>

#include "core/state_archive.h"
#include "tracking/finishing/track_score.h"

namespace eyrie::live_scores_test {
namespace {

const SceneScale kLiveScale{.gsd_m_per_px = 0.2, .frame_rate_hz = 25, .gsd_known = true};
constexpr int kLiveFrames = 70;

/// A car that turns, under a camera that flies on, turns and zooms; seen like a vehicle in every third frame, lost now
/// and then, and standing for a while.
struct TurningCar {
    static FrameMotion motionAt(FrameIndex frame) {
        FrameMotion motion;
        motion.frame = frame;
        motion.image_size = {1000, 600};
        motion.registration.state = frame == 0    ? RegistrationState::first
                                    : frame == 31 ? RegistrationState::failed
                                                  : RegistrationState::registered;
        if (frame > 0)
            motion.registration.current_from_previous.matrix = {1.001, 0.002, 2.5, -0.002, 1, 0.4, 1e-7, 0, 1};
        return motion;
    }
    static TrackState stateAt(FrameIndex frame) {
        TrackState state;
        state.id = 3;
        state.box = {{200 + 6.3 * frame, 200 + 0.05 * frame * frame}, 20, 10, 0.01 * frame};
        state.status = TrackStatus::confirmed;
        state.origin = frame >= 50 && frame < 56 ? StateOrigin::standing
                       : frame % 7 == 5          ? StateOrigin::predicted
                                                 : StateOrigin::detected;
        return state;
    }
    static std::vector<Detection> detectionsAt(FrameIndex frame) {
        Detection detection;
        detection.box = stateAt(frame).box;
        detection.complete = frame % 3 == 0;
        if (frame % 4 == 0) detection.decision = 0.3 * frame - 8;
        return {detection};
    }
};

/// What finishing would say of the frames up to this one.
double scoreOfPath(FrameIndex last) {
    TrackPath path{3, {}};
    GroundMotion ground;
    TrackLooks looks;
    for (FrameIndex frame = 0; frame <= last; ++frame) {
        const FrameMotion motion = TurningCar::motionAt(frame);
        ground.add({frame, motion.registration, motion.image_size});
        path.states.emplace_back(frame, PathState(TurningCar::stateAt(frame)));
        const TrackState state = TurningCar::stateAt(frame);
        if (state.origin == StateOrigin::detected) looks.add(state.box, classifiedOf(TurningCar::detectionsAt(frame)));
    }
    return evidenceOf(path, looks, ground, kLiveScale).score;
}

double judged(LiveScores& scores, FrameIndex frame) {
    std::vector<TrackState> tracks{TurningCar::stateAt(frame)};
    scores.judge(tracks, TurningCar::detectionsAt(frame), TurningCar::motionAt(frame));
    return tracks.front().score;
}

}  // namespace

TEST(LiveScores, AreThoseOfAFinishedTrackThatEndedHere) {
    LiveScores scores(kLiveScale);
    for (FrameIndex frame = 0; frame < kLiveFrames; ++frame)
        ASSERT_NEAR(judged(scores, frame), scoreOfPath(frame), 1e-6) << frame;
}

TEST(LiveScores, GoOnAfterBeingKept) {
    LiveScores whole(kLiveScale);
    LiveScores stopped(kLiveScale);
    for (FrameIndex frame = 0; frame < 40; ++frame) {
        judged(whole, frame);
        judged(stopped, frame);
    }
    StateWriter writer;
    writer(stopped);
    const std::string bytes = writer.bytes();
    StateReader reader(bytes, [](FrameIndex) { return cv::Mat(); });
    LiveScores resumed(kLiveScale);
    reader(resumed);
    reader.end();
    for (FrameIndex frame = 40; frame < kLiveFrames; ++frame)
        ASSERT_EQ(judged(resumed, frame), judged(whole, frame)) << frame;
}

TEST(LiveScores, ForgetTracksThatEnded) {
    LiveScores scores(kLiveScale);
    for (FrameIndex frame = 0; frame < 30; ++frame) judged(scores, frame);
    std::vector<TrackState> none;
    scores.judge(none, {}, TurningCar::motionAt(30));
    LiveScores fresh(kLiveScale);
    EXPECT_EQ(judged(scores, 31), judged(fresh, 31));
}

}  // namespace eyrie::live_scores_test
