// What is carried over the ground from frame to frame: compared with the same sums done plainly.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <random>

#include "core/geometry/angle.h"
#include "tracking/finishing/track_occupancy.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/frame_summaries.h"
#include "tracking/tracked_scene.h"

namespace eyrie::ground_paths_test {
namespace {

using test::MovingScene;

/// Under a camera that turns, zooms and drifts, the picture 640 × 480 px.
MovingScene movingScene() {
    MovingScene scene;
    scene.objects = {{{250, 180}, {1.5, 0.8}, 20, 10, 0}};
    scene.camera.turn = [](int frame) { return 0.012 * frame; };
    scene.camera.zoom = [](int frame) { return 1 + 0.004 * frame; };
    scene.camera.shift = [](int frame) { return cv::Point2d(-1.1 * frame, 0.4 * frame); };
    return scene;
}

std::vector<FrameMotionSummary> summariesOf(const MovingScene& scene, int frames) {
    std::vector<FrameMotionSummary> result;
    for (int frame = 0; frame < frames; ++frame) {
        const FrameMotion motion = scene.motion(frame);
        result.push_back({frame, motion.registration, motion.image_size});
    }
    return result;
}

TrackPath pathOf(const MovingScene& scene, int first, int last) {
    TrackPath path{1, {}};
    for (int frame = first; frame <= last; ++frame) {
        TrackState state;
        state.box = scene.box(0, frame);
        state.velocity = scene.velocity(0, frame);
        state.status = TrackStatus::confirmed;
        path.states.emplace_back(frame, PathState(state));
    }
    return path;
}

double weightOf(StateOrigin origin) {
    switch (origin) {
        case StateOrigin::detected:
            return 1;
        case StateOrigin::predicted:
            return 0.1;
        default:
            return 0.6;
    }
}

/// Value and slope at time 0 of a polynomial fitted by the pseudo-inverse.
std::pair<double, double> fitted(const std::vector<double>& times, const std::vector<double>& values,
                                 const std::vector<double>& weights, int degree) {
    cv::Mat1d a(int(times.size()), degree + 1);
    cv::Mat1d b(int(times.size()), 1);
    for (std::size_t i = 0; i < times.size(); ++i) {
        const double root = std::sqrt(weights[i]);
        for (int power = 0; power <= degree; ++power) a(int(i), power) = root * std::pow(times[i], power);
        b(int(i)) = root * values[i];
    }
    cv::Mat1d solution;
    cv::solve(a, b, solution, cv::DECOMP_SVD);
    return {solution(0), solution(1)};
}

}  // namespace

TEST(GroundMotion, CarriesForwardBackwardAndThroughFrozenFrames) {
    const MovingScene scene = movingScene();
    auto summaries = summariesOf(scene, 30);
    const GroundMotion ground(summaries);
    const MovingState at5{scene.box(0, 5), scene.velocity(0, 5)};
    for (const int to : {5, 6, 20, 0}) {
        const auto carried = ground.carried(at5, 5, to, false);
        ASSERT_TRUE(carried);
        EXPECT_NEAR(carried->box.centre.x, scene.box(0, to).centre.x, 1e-6);
        EXPECT_NEAR(carried->box.centre.y, scene.box(0, to).centre.y, 1e-6);
        EXPECT_NEAR(carried->box.length, scene.box(0, to).length, 1e-6);
        EXPECT_NEAR(carried->box.width, scene.box(0, to).width, 1e-6);
        EXPECT_NEAR(turnBetween(carried->box.heading, scene.box(0, to).heading), 0, 1e-9);
        EXPECT_NEAR(carried->velocity.x, scene.velocity(0, to).x, 1e-6);
        EXPECT_NEAR(carried->velocity.y, scene.velocity(0, to).y, 1e-6);
    }
    // In a frozen frame nothing moves by itself.
    std::vector<FrameMotionSummary> still;
    for (int frame = 0; frame < 6; ++frame) still.push_back(test::summaryOfFrame(frame));
    still[3].registration.state = RegistrationState::frozen;
    const GroundMotion frozen(still);
    const MovingState moving{{{100, 100}, 20, 10, 0}, {2, 1}};
    EXPECT_NEAR(frozen.carried(moving, 0, 5, true)->box.centre.x, 108, 1e-9);
    EXPECT_NEAR(frozen.carried(moving, 5, 0, true)->box.centre.y, 96, 1e-9);
    EXPECT_NEAR(frozen.carried(moving, 2, 3, true)->box.centre.x, 100, 1e-9);
    EXPECT_NEAR(frozen.carried(moving, 3, 2, true)->box.centre.x, 100, 1e-9);
    EXPECT_NEAR(frozen.carried(moving, 3, 4, true)->box.centre.x, 102, 1e-9);
    // After it, it makes good what passed meanwhile.
    still[4].registration.elapsed = 3;
    const GroundMotion went_on(still);
    EXPECT_NEAR(went_on.carried(moving, 3, 4, true)->box.centre.x, 106, 1e-9);
    EXPECT_NEAR(went_on.carried(moving, 4, 3, true)->box.centre.y, 97, 1e-9);
    EXPECT_NEAR(went_on.carried(moving, 0, 5, true)->box.centre.x, 112, 1e-9);
}

TEST(GroundMotion, KnowsOnlyAdjacentFramesThatWereRegistered) {
    std::vector<FrameMotionSummary> motion;
    for (const int frame : {10, 11, 12, 15, 16, 17, 18}) motion.push_back(test::summaryOfFrame(frame, frame));
    motion[0].registration.state = RegistrationState::first;
    motion[4].registration.state = RegistrationState::failed;
    motion[5].registration.current_from_previous.matrix = cv::Matx33d::zeros();
    motion[6].registration.current_from_previous.matrix(1, 1) = NAN;
    const GroundMotion ground(motion);
    const auto shiftOf = [&](int from, int to, bool guesses) {
        const cv::Matx33d* step = ground.step(from, to, guesses);
        return step == nullptr ? 0 : (*step)(0, 2);
    };
    EXPECT_EQ(shiftOf(10, 11, false), 11);
    EXPECT_EQ(shiftOf(11, 10, false), -11);
    EXPECT_EQ(shiftOf(11, 12, false), 12);
    EXPECT_EQ(shiftOf(14, 15, false), 15);
    EXPECT_EQ(shiftOf(10, 12, true), 0);
    EXPECT_EQ(shiftOf(11, 11, true), 0);
    EXPECT_EQ(shiftOf(9, 10, true), 0) << "the first";
    EXPECT_EQ(shiftOf(12, 13, true), 0);
    EXPECT_EQ(shiftOf(13, 14, true), 0);
    EXPECT_EQ(shiftOf(15, 16, false), 0);
    EXPECT_EQ(shiftOf(15, 16, true), 16) << "a guess";
    EXPECT_EQ(shiftOf(16, 17, true), 0) << "degenerate";
    EXPECT_EQ(ground.step(17, 18, true), nullptr) << "not finite";
    EXPECT_EQ(shiftOf(18, 19, true), 0);
    EXPECT_EQ(ground.imageSize(16), cv::Size(640, 360));
    EXPECT_EQ(ground.imageSize(13), cv::Size());
    EXPECT_EQ(ground.imageSize(9), cv::Size());
    EXPECT_EQ(ground.imageSize(19), cv::Size());
    EXPECT_FALSE(ground.carried({{{1, 1}, 2, 1, 0}, {0, 0}}, 11, 13, true));
    EXPECT_EQ(GroundMotion().step(0, 1, true), nullptr);
}

TEST(GroundMotion, ABoxIsCutWhereAHundredthOfItIsOutside) {
    const GroundMotion ground({test::summaryOfFrame(0)});
    // 20 px long: at x = 629.5 it ends with the picture.
    EXPECT_FALSE(ground.cutByBorder({{629.5 + 0.19, 100}, 20, 10, 0}, 0));
    EXPECT_TRUE(ground.cutByBorder({{629.5 + 0.21, 100}, 20, 10, 0}, 0));
    EXPECT_FALSE(ground.cutByBorder({{900, 100}, 20, 10, 0}, 1)) << "nothing is known of the picture";
}

/// A camera that stands still and sees the horizon at y = 108.
GroundMotion towardsTheHorizon(int frames) {
    std::vector<FrameMotionSummary> motion;
    for (int frame = 0; frame < frames; ++frame) motion.push_back(test::summaryOfFrame(frame));
    GroundMotion ground(motion);
    ground.seenAt({0, 0.0125, 320, 188});
    return ground;
}

TEST(GroundMotion, WhatComesNearerGrowsAndShrinksOnItsWayBack) {
    const GroundMotion ground = towardsTheHorizon(30);
    // 40 px below the horizon at first, 100 px after 20 frames.
    const MovingState far{{{300, 148}, 20, 10, 0.3}, {1, 3}};
    const auto near = ground.carried(far, 0, 20, false);
    ASSERT_TRUE(near);
    EXPECT_NEAR(near->box.centre.y, 208, 1e-9);
    EXPECT_NEAR(near->box.length, 50, 1e-9);
    EXPECT_NEAR(near->box.width, 25, 1e-9);
    const auto back = ground.carried(*near, 20, 0, false);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->box.length, 20, 1e-9);
    EXPECT_NEAR(back->box.centre.x, 300, 1e-9);
    // What stands does not grow, and nothing does in a flat view.
    EXPECT_EQ(ground.carried({far.box, {0, 0}}, 0, 20, false)->box.length, 20);
    GroundMotion flat = ground;
    flat.seenAt({});
    EXPECT_EQ(flat.carried(far, 0, 20, false)->box.length, 20);
}

TEST(GroundMotion, AboveTheHorizonIsNoGround) {
    const GroundMotion ground = towardsTheHorizon(1);
    // A tenth of the 80 px from the horizon to the place that the scale counts from is left for its error.
    EXPECT_TRUE(ground.aboveHorizon({{300, 94.9}, 20, 10, 0}));
    EXPECT_FALSE(ground.aboveHorizon({{300, 95.1}, 20, 10, 0})) << "its lower edge";
    EXPECT_FALSE(ground.aboveHorizon({{300, 200}, 20, 10, 0}));
    EXPECT_FALSE(GroundMotion().aboveHorizon({{300, 1}, 2, 1, 0})) << "seen from above";
}

TEST(TrackOccupancy, IsAskedByFrameAndLetsBoxesTouch) {
    TrackPath path{1, {}};
    for (const int frame : {30, 31, 32, 33, 70}) {
        TrackState state;
        state.box = {{100.0 + frame, 50}, 20, 10, 0};
        path.states.emplace_back(frame, PathState(state));
    }
    std::vector<TrackPath> paths{path};
    TrackOccupancy taken(paths);
    for (const int frame : {30, 32, 70}) {
        ASSERT_EQ(taken.in(frame).size(), 1U) << frame;
        EXPECT_EQ(taken.in(frame)[0].centre.x, 100 + frame);
    }
    for (const int frame : {29, 34, 64, 95, 96}) EXPECT_TRUE(taken.in(frame).empty()) << frame;
    // (20 − d) / (20 + d) = .15 at d = 14.78.
    EXPECT_TRUE(taken.isFree(32, {{132 + 14.9, 50}, 20, 10, 0}));
    EXPECT_FALSE(taken.isFree(32, {{132 + 14.6, 50}, 20, 10, 0}));
    EXPECT_TRUE(taken.isFree(34, {{134, 50}, 20, 10, 0}));
    TrackState earlier;
    earlier.box = {{7, 7}, 20, 10, 0};
    prepend(paths[0], {{1, PathState(earlier)}, {0, PathState(earlier)}});
    EXPECT_EQ(paths[0].states.front().first, 0) << "handed over with the latest first";
    taken.extended(paths[0]);
    EXPECT_EQ(taken.in(1).size(), 1U);
    EXPECT_EQ(taken.in(33).size(), 1U);
}

TEST(SmoothPath, LeavesATrackWhereThePictureStands) {
    // A vehicle at 3 px/frame: the picture stands in frames 15 to 19, and in 20 all that was lost has passed.
    std::vector<FrameMotionSummary> motion;
    motion.reserve(40);
    for (int frame = 0; frame < 40; ++frame) motion.push_back(test::summaryOfFrame(frame));
    for (int frame = 15; frame < 20; ++frame) motion[std::size_t(frame)].registration.state = RegistrationState::frozen;
    motion[20].registration.elapsed = 6;
    TrackPath path{1, {}};
    path.states.reserve(40);
    for (int frame = 0; frame < 40; ++frame) {
        const int shown = frame >= 15 && frame < 20 ? 14 : frame;
        TrackState state;
        state.id = 1;
        state.box = {{10.0 + 3 * shown, 50}, 20, 10, 0};
        state.velocity = {3, 0};
        state.origin = StateOrigin::detected;
        path.states.emplace_back(frame, PathState(state));
    }
    TrackPath smooth = path;
    smoothPath(smooth, GroundMotion(motion), 8);
    for (std::size_t i = 0; i < path.states.size(); ++i) {
        EXPECT_NEAR(smooth.states[i].second.box.centre.x, path.states[i].second.box.centre.x, 1e-3) << i;
        EXPECT_NEAR(smooth.states[i].second.velocity.x, 3, 1e-3) << i;
    }
}

TEST(SmoothPath, IsAFitOverTheGroundOfNearStatesByTheirWeights) {
    const MovingScene scene = movingScene();
    constexpr int kFrames = 40, kHalf = 6;
    const GroundMotion ground(summariesOf(scene, kFrames));
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, 1);
    TrackPath path = pathOf(scene, 0, kFrames - 1);
    const StateOrigin origins[] = {StateOrigin::detected, StateOrigin::reconstructed, StateOrigin::detected,
                                   StateOrigin::predicted, StateOrigin::standing};
    for (auto& [frame, state] : path.states) {
        state.box.centre += cv::Point2f(float(0.7 * noise(random)), float(0.7 * noise(random)));
        state.box.heading += static_cast<float>(0.1 * noise(random));
        state.origin = origins[frame % 5];
    }
    path.states.erase(path.states.begin() + 20, path.states.begin() + 23);
    TrackPath smooth = path;
    smoothPath(smooth, ground, kHalf);
    ASSERT_EQ(smooth.states.size(), path.states.size());
    for (std::size_t i = 0; i < path.states.size(); ++i) {
        const auto& [here, state] = path.states[i];
        std::vector<double> times, xs, ys, turns, weights;
        int before = 0, after = 0;
        for (const auto& [frame, other] : path.states) {
            const double apart = frame - here;
            if (std::abs(apart) > kHalf) continue;
            const auto carried = ground.carried({other.box, {0, 0}}, frame, here, false);
            const double near = 1 - std::pow(std::abs(apart) / 7, 3);
            times.push_back(apart);
            xs.push_back(carried->box.centre.x);
            ys.push_back(carried->box.centre.y);
            turns.push_back(axisTurnBetween(state.box.heading, carried->box.heading));
            weights.push_back(weightOf(other.origin) * near * near * near);
            before += apart < 0;
            after += apart > 0;
        }
        const int degree = before >= 3 && after >= 3 ? 2 : 1;
        const auto [x, vx] = fitted(times, xs, weights, degree);
        const auto [y, vy] = fitted(times, ys, weights, degree);
        const PathState& result = smooth.states[i].second;
        EXPECT_NEAR(result.box.centre.x, x, 1e-3) << here;
        EXPECT_NEAR(result.box.centre.y, y, 1e-3) << here;
        EXPECT_NEAR(result.velocity.x, vx, 1e-3) << here;
        EXPECT_NEAR(result.velocity.y, vy, 1e-3) << here;
        // Half a length of way is nothing yet, one and a half are all: it points along its path then.
        const double fit = state.box.heading + fitted(times, turns, weights, 1).first;
        const double way = std::hypot(vx, vy) * (times.back() - times.front()) / state.box.length;
        const double trust = std::clamp(way - 0.5, 0.0, 1.0);
        const double heading = fit + trust * axisTurnBetween(fit, std::atan2(vy, vx));
        EXPECT_NEAR(axisTurnBetween(heading, result.box.heading), 0, 1e-3) << here;
        EXPECT_EQ(result.box.length, state.box.length);
        EXPECT_EQ(result.origin, state.origin);
    }
}

TEST(SmoothPath, PointsAsItDrivesAndNeedsFourStates) {
    const GroundMotion ground(summariesOf(movingScene(), 40));
    TrackPath reversed = pathOf(movingScene(), 0, 30);
    for (auto& [frame, state] : reversed.states) state.box.heading = float(wrapPi(state.box.heading + kPi));
    smoothPath(reversed, ground, 12);
    EXPECT_NEAR(turnBetween(reversed.states[15].second.box.heading, movingScene().box(0, 15).heading), 0, 1e-3);
    for (const int last : {2, 3}) {
        TrackPath few = pathOf(movingScene(), 0, last);
        few.states[1].second.box.centre.x += 1;
        const cv::Point2d before = few.states[1].second.box.centre;
        smoothPath(few, ground, 12);
        EXPECT_EQ(cv::Point2d(few.states[1].second.box.centre) == before, last == 2);
    }
}

TEST(SteadySize, IsTheWeightedMedianOnTheGround) {
    const MovingScene scene = movingScene();
    constexpr int kFrames = 40, kHalf = 7;
    const GroundMotion ground(summariesOf(scene, kFrames));
    std::mt19937 random(6);
    std::normal_distribution<double> noise(0, 1);
    TrackPath path = pathOf(scene, 0, kFrames - 1);
    for (auto& [frame, state] : path.states) {
        state.box.length += static_cast<float>(2 * noise(random));
        state.box.width += static_cast<float>(noise(random));
        if (frame % 3 == 0) state.origin = StateOrigin::predicted;
        if (frame % 5 == 1) state.origin = StateOrigin::reconstructed;
    }
    path.states.erase(path.states.begin() + 11, path.states.begin() + 13);
    TrackPath steady = path;
    steadySize(steady, ground, kHalf);
    for (std::size_t i = 0; i < path.states.size(); ++i) {
        const int here = path.states[i].first;
        std::vector<std::pair<double, double>> lengths, widths;
        double all = 0;
        for (const auto& [frame, state] : path.states) {
            if (std::abs(frame - here) > kHalf) continue;
            const double zoom = (1 + 0.004 * here) / (1 + 0.004 * frame);
            lengths.emplace_back(state.box.length * zoom, weightOf(state.origin));
            widths.emplace_back(state.box.width * zoom, weightOf(state.origin));
            all += weightOf(state.origin);
        }
        const auto medianOf = [&](std::vector<std::pair<double, double>>& values) {
            std::sort(values.begin(), values.end());
            double sum = 0;
            for (const auto& [value, weight] : values) {
                if (2 * (sum += weight) >= all) return value;
            }
            return 0.0;
        };
        EXPECT_NEAR(steady.states[i].second.box.length, medianOf(lengths), 1e-3) << here;
        EXPECT_NEAR(steady.states[i].second.box.width, medianOf(widths), 1e-3) << here;
        EXPECT_EQ(cv::Point2d(steady.states[i].second.box.centre), cv::Point2d(path.states[i].second.box.centre));
    }
}

TEST(SteadySize, BoxesThatTheBorderCutHardlyCount) {
    std::vector<FrameMotionSummary> motion;
    TrackPath path{1, {}};
    for (int frame = 0; frame < 40; ++frame) {
        motion.push_back(test::summaryOfFrame(frame));
        TrackState state;
        // 38 of 40 are cut: of a twentieth of the weight each, they weigh 1.9 against 2.
        const bool cut = frame >= 2;
        state.box = {{cut ? 636.0 : 600.0, 100}, cut ? 9.0 : 20.0, 10, 0};
        path.states.emplace_back(frame, PathState(state));
    }
    steadySize(path, GroundMotion(motion), 40);
    for (const auto& [frame, state] : path.states) EXPECT_NEAR(state.box.length, 20, 1e-6) << frame;
}

TEST(SteadySize, FollowsAVehicleThatComesNearer) {
    const GroundMotion ground = towardsTheHorizon(30);
    TrackPath path{1, {}};
    for (int frame = 0; frame < 30; ++frame) {
        TrackState state;
        const double y = 138 + 3 * frame;
        // Every fifth box is half a vehicle.
        state.box = {{300, y}, 0.5 * (y - 108) * (frame % 5 == 2 ? 0.5 : 1), 0.2 * (y - 108), kPi / 2};
        path.states.emplace_back(frame, PathState(state));
    }
    steadySize(path, ground, 40);
    for (const auto& [frame, state] : path.states) {
        EXPECT_NEAR(state.box.length, 0.5 * (30 + 3 * frame), 1e-3) << frame;
        EXPECT_NEAR(state.box.width, 0.2 * (30 + 3 * frame), 1e-3) << frame;
    }
}

TEST(ExtendToRest, FollowsTheLeastAbsoluteDeviationsOfAnEvenAcceleration) {
    // 2 + .03 t²/2 px/frame … from rest 20 frames before; two of the first boxes lie askew.
    const SceneScale scale{0.2, 25, true};
    std::vector<FrameMotionSummary> motion;
    for (int frame = 0; frame < 140; ++frame) motion.push_back(test::summaryOfFrame(frame, 0.5));
    const GroundMotion ground(motion);
    const cv::Point2d direction(0.6, 0.8);
    constexpr double kAcceleration = 0.02;
    const auto placeAt = [&](int frame) {
        const double moving = std::max(0, frame - 40);
        return cv::Point2d(150 + 0.5 * frame, 60) + direction * (kAcceleration * moving * moving / 2);
    };
    TrackPath path{1, {}};
    for (int frame = 60; frame < 130; ++frame) {
        TrackState state;
        state.box = {placeAt(frame), 20, 9, std::atan2(0.8, 0.6)};
        state.velocity = direction * (kAcceleration * (frame - 40));
        state.hits = 3;
        path.states.emplace_back(frame, PathState(state));
    }
    path.states[1].second.box.centre -= cv::Point2f(direction * 1.5);
    path.states[4].second.box.centre -= cv::Point2f(direction * 1.5);
    std::vector<TrackPath> paths{path};
    extendToRest(paths, ground, 35, scale);
    ASSERT_EQ(paths[0].states.size(), 70U + 35U);
    for (const auto& [frame, state] : paths[0].states) {
        if (frame >= 60) break;
        EXPECT_NEAR(state.box.centre.x, placeAt(frame).x, 0.05) << frame;
        EXPECT_NEAR(state.box.centre.y, placeAt(frame).y, 0.05) << frame;
        EXPECT_NEAR(std::hypot(state.velocity.x, state.velocity.y), kAcceleration * std::max(0, frame - 40), 0.02);
        EXPECT_EQ(state.origin, StateOrigin::predicted);
        EXPECT_EQ(state.hits, 0);
    }
    // It was at rest 20 frames before: fewer do not reach back to there.
    for (const int frames : {18, 22}) {
        paths = {path};
        extendToRest(paths, ground, frames, scale);
        EXPECT_EQ(paths[0].states.size(), frames == 22 ? 92U : 70U);
    }
    // 12 states at least, that went a px.
    for (const int count : {11, 12}) {
        paths = {path};
        paths[0].states.erase(paths[0].states.begin(), paths[0].states.begin() + 5);
        paths[0].states.resize(std::size_t(count));
        extendToRest(paths, ground, 40, scale);
        EXPECT_EQ(paths[0].states.size() > std::size_t(count), count == 12);
    }
    paths = {path};
    extendToRest(paths, ground, 35, {0.25, 25, false});
    EXPECT_EQ(paths[0].states.size(), 70U) << "the scale is an assumption";
    // What was found at more than 3.5 m/s (.4 px/frame here) need not have stood.
    for (const double gsd : {0.33, 0.37}) {
        paths = {path};
        extendToRest(paths, ground, 35, {gsd, 25, true});
        EXPECT_EQ(paths[0].states.size() > 70, gsd < 0.35);
    }
}

TEST(ExtendToRest, EndsWhereATenthOfTheBoxLeavesThePicture) {
    std::vector<FrameMotionSummary> motion;
    for (int frame = 0; frame < 140; ++frame) motion.push_back(test::summaryOfFrame(frame, 0.5));
    const GroundMotion ground(motion);
    TrackPath path{1, {}};
    for (int frame = 60; frame < 130; ++frame) {
        const double moving = frame - 50;
        TrackState state;
        state.box = {{0.5 * (frame - 20) + 0.01 * moving * moving, 100}, 20, 9, 0};
        state.velocity = {0.02 * moving, 0};
        path.states.emplace_back(frame, PathState(state));
    }
    std::vector<TrackPath> paths{path};
    extendToRest(paths, ground, 59, {0.2, 25, true});
    // Standing, its centre is at (frame − 20) / 2; 18 of 20 px are to be seen from −.5 on: at 7.5 or more.
    EXPECT_EQ(paths[0].firstFrame(), 35);
}

}  // namespace eyrie::ground_paths_test
