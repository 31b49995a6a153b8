// Which motion vectors carry a track back in time, and how far: every limit on both sides.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tracking/finishing/flow_comparison.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/frame_summaries.h"

namespace eyrie::tracing_limits_test {
namespace {

constexpr FrameIndex kFound = 60;  ///< first frame of the track; it lives for 40
const cv::Point2d kTurns[] = {{1, 0}, {0, 1}, {-0.6, 0.8}};

GroundMotion standingGround() {
    GroundMotion ground;
    for (FrameIndex frame = 0; frame < 120; ++frame) ground.add(test::summaryOfFrame(frame));
    return ground;
}

/// A car of 20 × 10 px that drives into a direction; in frame 60 it is at (320, 180).
struct Traced {
    cv::Point2d direction{1, 0};
    double speed = 1;
    cv::Point2d start{320, 180};
    std::vector<TrackPath> others;

    OrientedBox boxAt(FrameIndex frame) const {
        return {start + direction * (speed * (frame - kFound)), 20, 10, std::atan2(direction.y, direction.x)};
    }
    cv::Point2d turned(cv::Point2d v) const {
        return {direction.x * v.x - direction.y * v.y, direction.y * v.x + direction.x * v.y};
    }
    /// A vector at a place in the car's axes, with a velocity in them.
    MotionVector vector(CornerId id, FrameIndex frame, cv::Point2d in_box, cv::Point2d velocity) const {
        return {id, cv::Point2f(boxAt(frame).toImage(in_box)), cv::Point2f(turned(velocity)), 9};
    }
    using Vectors = std::function<std::vector<MotionVector>(FrameIndex)>;
    TrackPath traced(const Vectors& vectors, int most = 100) const {
        TrackPath path{1, {}};
        for (FrameIndex frame = kFound; frame < kFound + 40; ++frame) {
            TrackState state;
            state.id = 1;
            state.box = boxAt(frame);
            state.velocity = direction * speed;
            state.hits = 5;
            path.states.emplace_back(frame, PathState(state));
        }
        std::vector<TrackPath> paths{path};
        paths.insert(paths.end(), others.begin(), others.end());
        traceBack(paths, standingGround(), vectors, most);
        return paths[0];
    }
    int framesBack(const Vectors& vectors, int most = 100) const {
        return static_cast<int>(traced(vectors, most).states.size()) - 40;
    }
};

/// Whether one vector that stays in the car carries the track back.
void expectCarries(bool expected, cv::Point2d in_box, cv::Point2d velocity, double speed = 1) {
    for (const cv::Point2d& direction : kTurns) {
        Traced car;
        car.direction = direction;
        car.speed = speed;
        const int back =
            car.framesBack([&](FrameIndex frame) { return std::vector{car.vector(7, frame, in_box, velocity)}; }, 10);
        EXPECT_EQ(back, expected ? 10 : 0) << in_box << velocity << direction;
    }
}

}  // namespace

TEST(TracingLimits, AVectorLiesAtMostAPixelBesideTheBox) {
    expectCarries(true, {10.9, 0}, {1, 0});
    expectCarries(false, {11.1, 0}, {1, 0});
    expectCarries(true, {-10.9, 5.9}, {1, 0});
    expectCarries(false, {0, -6.1}, {1, 0});
}

TEST(TracingLimits, AVectorMovesAlikeByAShareOfTheSpeedOrAFloor) {
    expectCarries(true, {0, 0}, {1.34, 0});
    expectCarries(false, {0, 0}, {1.36, 0});
    expectCarries(true, {0, 0}, {1, -0.34});
    expectCarries(false, {0, 0}, {1, 0.36});
    expectCarries(true, {0, 0}, {0.179, 0}, 0.1);
    expectCarries(false, {0, 0}, {0.181, 0}, 0.1);
}

TEST(TracingLimits, TwoNewcomersSupportATrackAndOneDoesNot) {
    const Traced car;
    for (const int count : {1, 2}) {
        const auto changing = [&](FrameIndex frame) {
            std::vector<MotionVector> vectors;
            for (int i = 0; i < count; ++i)
                vectors.push_back(car.vector(1000 - 2 * frame + i, frame, {i * 4., 2}, {1, 0}));
            return vectors;
        };
        EXPECT_EQ(car.framesBack(changing, 10), count == 2 ? 10 : 0);
    }
}

TEST(TracingLimits, TheBoxGoesWhereItsCornersWereAndItsVelocityFollowsByThreeTenths) {
    // The corner sat at 3 px ahead; a frame before it was 1.4 px behind that.
    Traced car;
    const auto vectors = [&](FrameIndex frame) {
        return std::vector<MotionVector>{{7, cv::Point2f(float(323 - 1.4 * (kFound - frame)), 181), {1.2F, 0.1F}, 9}};
    };
    const TrackPath path = car.traced(vectors, 2);
    ASSERT_EQ(path.states.size(), 42U);
    const PathState& first = path.states[1].second;
    EXPECT_NEAR(first.box.centre.x, 320 - 1.4, 1e-3);
    EXPECT_NEAR(first.box.centre.y, 180, 1e-3);
    EXPECT_NEAR(first.velocity.x, 1.06, 1e-6);
    EXPECT_NEAR(first.velocity.y, 0.03, 1e-6);
    EXPECT_EQ(first.origin, StateOrigin::reconstructed);
    EXPECT_EQ(first.hits, 0);
    EXPECT_NEAR(path.states[0].second.box.centre.x, 320 - 2.8, 1e-3);
    EXPECT_NEAR(path.states[0].second.velocity.x, 1.06 + 0.3 * 0.14, 1e-6);
    // Of three corners the one in the middle counts.
    const auto three = [&](FrameIndex frame) {
        std::vector<MotionVector> all;
        for (const auto& [id, back] : {std::pair(1, 0.9), {2, 1.2}, {3, 1.25}})
            all.push_back({id, cv::Point2f(float(320 - back * (kFound - frame)), float(176 + id)), {1, 0}, 9});
        return all;
    };
    EXPECT_NEAR(car.traced(three, 1).states[0].second.box.centre.x, 320 - 1.2, 1e-3);
}

TEST(TracingLimits, EightFramesWithoutSupportAreBridged) {
    const Traced car;
    for (const int gap : {8, 9}) {
        const auto vectors = [&](FrameIndex frame) {
            std::vector<MotionVector> found;
            if (frame >= kFound - 2 || frame < kFound - 2 - gap) {
                for (const CornerId id : {1, 2}) found.push_back(car.vector(id, frame, {id * 3., 1}, {1, 0}));
            }
            return found;
        };
        EXPECT_EQ(car.framesBack(vectors), gap == 8 ? 20 : 2) << "by half of its life at most";
    }
}

TEST(TracingLimits, EndsWhereHalfOfTheBoxHasLeftThePicture) {
    Traced car;
    const auto vectors = [&](FrameIndex frame) { return std::vector{car.vector(7, frame, {6, 1}, {1, 0})}; };
    car.start = {6.3, 180};  // centres from −.5 on: back to −.7 … in seven frames
    EXPECT_EQ(car.framesBack(vectors), 6);
    car.start = {6.7, 180};
    EXPECT_EQ(car.framesBack(vectors), 7);
}

TEST(TracingLimits, AnotherTrackStopsItAndKeepsItsVectors) {
    Traced car;
    const auto own = [&](FrameIndex frame) { return std::vector{car.vector(7, frame, {0, 3}, {1, 0})}; };
    TrackPath other{2, {}};
    for (FrameIndex frame = 40; frame < 55; ++frame) {
        TrackState state;
        state.box = car.boxAt(frame);
        state.box.centre.y += 3;
        other.states.emplace_back(frame, PathState(state));
    }
    car.others = {other};
    EXPECT_EQ(car.framesBack(own), 5) << "it lies on the other from frame 54 on";
    // Beside it by 8.5 of 10 px: less than .15 shared, but the only corner is the other's.
    for (auto& [frame, state] : car.others[0].states) state.box.centre.y = 180 + 8.5F;
    const auto shared = [&](FrameIndex frame) { return std::vector{car.vector(7, frame, {0, 4.5}, {1, 0})}; };
    EXPECT_EQ(car.framesBack(shared), 6) << "it came from there, but is not followed further";
    EXPECT_EQ(car.framesBack(own), 20);
}

TEST(TracingLimits, WhatBeganWithAPredictionWasTracedBefore) {
    Traced car;
    TrackPath path = car.traced([](FrameIndex) { return std::vector<MotionVector>{}; });
    path.states[0].second.origin = StateOrigin::predicted;
    std::vector<TrackPath> paths{path};
    const VectorsAt vectors = [&](FrameIndex frame) { return std::vector{car.vector(7, frame, {0, 0}, {1, 0})}; };
    traceBack(paths, standingGround(), vectors, 10);
    EXPECT_EQ(paths[0].states.size(), 40U);
    paths[0].states[0].second.origin = StateOrigin::detected;
    traceBack(paths, standingGround(), vectors, 0);
    EXPECT_EQ(paths[0].states.size(), 40U);
    traceBack(paths, standingGround(), {}, 10);
    EXPECT_EQ(paths[0].states.size(), 40U);
    traceBack(paths, standingGround(), vectors, 10);
    EXPECT_EQ(paths[0].states.size(), 50U);
}

TEST(TracingLimits, FlowIsComparedOverTwentyFourFramesEverySixFrames) {
    // The ground goes 2 px/frame; the track moves by (0, t²/50) in t frames of its own.
    GroundMotion ground;
    for (FrameIndex frame = 0; frame < 120; ++frame) ground.add(test::summaryOfFrame(frame, 2));
    TrackPath path{1, {}};
    for (FrameIndex frame = 0; frame < 70; ++frame) {
        TrackState state;
        state.box = {{10 + 2.0 * frame, 50 + frame * frame / 50.0}, 20, 10, 0};
        path.states.emplace_back(frame, PathState(state));
    }
    std::vector<double> ratios;
    for (int first = 0; first < 70; first += 6) {
        const int last = std::min(first + 24, 69);
        if (last - first < 8) continue;
        ratios.push_back((last * last - first * first) / 50.0 / ((2 + 0.05) * (last - first)));
    }
    const auto compared = comparedWithFlow(path, ground);
    ASSERT_TRUE(compared);
    std::sort(ratios.begin(), ratios.end());
    EXPECT_NEAR(compared->fastest, ratios.back(), 1e-4);
    EXPECT_NEAR(compared->ratio, ratios[ratios.size() / 2], 1e-4);
    EXPECT_NEAR(compared->flow, 2, 1e-4);
}

TEST(TracingLimits, ExtendingBackKeepsHalfOfTheBoxInThePictureAndOffOthers) {
    const GroundMotion ground = standingGround();
    const auto back = [&](double x, int frames, int entry, const std::vector<TrackPath>& others = {}) {
        Traced car;
        car.start = {x, 180};
        TrackPath path = car.traced([](FrameIndex) { return std::vector<MotionVector>{}; });
        std::vector<TrackPath> paths{path};
        paths.insert(paths.end(), others.begin(), others.end());
        extendBack(paths, ground, frames, entry);
        return int(paths[0].states.size()) - 40;
    };
    EXPECT_EQ(back(320, 5, 0), 5);
    EXPECT_EQ(back(3.7, 9, 0), 4) << "half of it is in the picture at −.3, not at −1.3";
    EXPECT_EQ(back(3.3, 9, 0), 3);
    // It came in over the border eight frames before: back to there, but not if that is longer ago than allowed.
    EXPECT_EQ(back(7.7, 2, 9), 8);
    EXPECT_EQ(back(7.7, 2, 8), 2);
    EXPECT_EQ(back(7.7, 0, 9), 8);
    EXPECT_EQ(back(320, 0, 9), 0);
}

TEST(TracingLimits, NothingIsExtendedOverAFrameThatCouldNotBeRegistered) {
    // It came in eight frames before, but how the ground moved five frames before is only guessed.
    std::vector<FrameMotionSummary> motion;
    for (FrameIndex frame = 0; frame < 120; ++frame) motion.push_back(test::summaryOfFrame(frame));
    motion[kFound - 4].registration.state = RegistrationState::failed;
    Traced car;
    car.start = {7.7, 180};
    std::vector<TrackPath> paths{car.traced([](FrameIndex) { return std::vector<MotionVector>{}; })};
    extendBack(paths, GroundMotion(motion), 2, 20);
    EXPECT_EQ(paths[0].states.size(), 42U);
    paths[0].states.erase(paths[0].states.begin(), paths[0].states.begin() + 2);
    extendBack(paths, GroundMotion(motion), 9, 0);
    EXPECT_EQ(paths[0].states.size(), 44U) << "as far as it is known";
}

}  // namespace eyrie::tracing_limits_test
