#include "tracking/finishing/track_finishing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "tracking/tracked_scene.h"

namespace eyrie::track_finishing_test {
namespace {

using test::MovingScene;

std::vector<FrameMotionSummary> summariesOf(const MovingScene& scene, int frames) {
    std::vector<FrameMotionSummary> result;
    for (int frame = 0; frame < frames; ++frame) {
        const FrameMotion motion = scene.motion(frame);
        result.push_back({frame, motion.registration, motion.image_size});
    }
    return result;
}

TrackState trueState(const MovingScene& scene, std::size_t object, int frame, TrackId id) {
    TrackState state;
    state.id = id;
    state.box = scene.box(object, frame);
    state.velocity = scene.velocity(object, frame);
    state.status = TrackStatus::confirmed;
    return state;
}

MovingScene oneCar() {
    MovingScene scene;
    scene.objects = {{{250, 180}, {1.5, 0.8}, 20, 10, 0}};
    scene.camera.turn = [](int frame) { return 0.01 * frame; };
    scene.camera.zoom = [](int frame) { return 1 + 0.003 * frame; };
    scene.camera.shift = [](int frame) { return cv::Point2d(-1.0 * frame, 0.3 * frame); };
    return scene;
}

void expectOrdered(const std::vector<TimedState>& states) {
    for (std::size_t i = 1; i < states.size(); ++i) {
        const auto a = std::pair(states[i - 1].first, states[i - 1].second.id);
        const auto b = std::pair(states[i].first, states[i].second.id);
        EXPECT_LT(a, b) << "ordered, and one state per frame and id";
    }
}

}  // namespace

TEST(FinishTracks, cleanTracksComeOutAsTheyWentInAndTwiceIsOnce) {
    MovingScene scene = oneCar();
    scene.objects.push_back({{300, 300}, {-1, 0.4}, 24, 11, 100});
    std::vector<TimedState> states;
    for (int frame = 49; frame >= 0; --frame) {
        for (std::size_t i = 0; i < 2; ++i) states.emplace_back(frame, trueState(scene, i, frame, int(i) + 1));
    }
    const auto summaries = summariesOf(scene, 50);
    const auto once = finishTracks(states, summaries, {}, scene.scale);
    ASSERT_EQ(once.size(), 100u);
    expectOrdered(once);
    for (const auto& [frame, state] : once) {
        const OrientedBox truth = scene.box(std::size_t(state.id - 1), frame);
        EXPECT_NEAR(state.box.centre.x, truth.centre.x, 1e-4);
        EXPECT_NEAR(state.box.centre.y, truth.centre.y, 1e-4);
        EXPECT_NEAR(state.box.length, truth.length, 1e-4);
        EXPECT_NEAR(turnBetween(state.box.heading, truth.heading), 0, 1e-4);
    }
    const auto twice = finishTracks(once, summaries, {}, scene.scale);
    ASSERT_EQ(twice.size(), once.size());
    for (std::size_t i = 0; i < once.size(); ++i) {
        EXPECT_EQ(twice[i].first, once[i].first);
        EXPECT_NEAR(twice[i].second.box.centre.x, once[i].second.box.centre.x, 1e-4);
        EXPECT_NEAR(twice[i].second.box.width, once[i].second.box.width, 1e-4);
    }
}

TEST(FinishTracks, smoothingReducesNoise) {
    const MovingScene scene = oneCar();
    std::mt19937 random(2);
    std::normal_distribution<double> noise(0, 1);
    std::vector<TimedState> states;
    double position_before = 0;
    double heading_before = 0;
    double size_before = 0;
    for (int frame = 0; frame < 80; ++frame) {
        TrackState state = trueState(scene, 0, frame, 7);
        const OrientedBox truth = state.box;
        state.box.centre += cv::Point2d(noise(random), noise(random));
        state.box.heading += 0.1 * noise(random);
        state.box.length += 2 * noise(random);
        position_before += std::pow(state.box.centre.x - truth.centre.x, 2);
        heading_before += std::pow(turnBetween(truth.heading, state.box.heading), 2);
        size_before += std::pow(state.box.length - truth.length, 2);
        states.emplace_back(frame, state);
    }
    const auto finished = finishTracks(states, summariesOf(scene, 80), {}, scene.scale);
    ASSERT_EQ(finished.size(), 80u);
    double position = 0;
    double heading = 0;
    double size = 0;
    for (const auto& [frame, state] : finished) {
        const OrientedBox truth = scene.box(0, frame);
        position += std::pow(state.box.centre.x - truth.centre.x, 2);
        heading += std::pow(turnBetween(truth.heading, state.box.heading), 2);
        size += std::pow(state.box.length - truth.length, 2);
    }
    EXPECT_LT(position, 0.5 * position_before);
    EXPECT_LT(heading, 0.4 * heading_before);
    EXPECT_LT(size, 0.1 * size_before);
}

TEST(FinishTracks, onlyConfirmedTracksStayAndTheirTentativeBeginning) {
    const MovingScene scene = oneCar();
    std::vector<TimedState> states;
    for (int frame = 10; frame < 20; ++frame) {
        TrackState state = trueState(scene, 0, frame, 1);
        if (frame < 14) state.status = TrackStatus::tentative;
        states.emplace_back(frame, state);
        TrackState other = state;
        other.id = 2;
        other.box.centre.y += 100;
        other.status = TrackStatus::tentative;
        states.emplace_back(frame, other);
    }
    const auto finished = finishTracks(states, summariesOf(scene, 30), FinishingOptions::thesis(), scene.scale);
    ASSERT_EQ(finished.size(), 10u);
    EXPECT_EQ(finished.front().first, 10);
    for (const auto& [frame, state] : finished) {
        EXPECT_EQ(state.id, 1);
        EXPECT_NE(state.status, TrackStatus::tentative);
    }
}

TEST(FinishTracks, predictedEndsAreTrimmedUnlessTheObjectLeft) {
    MovingScene scene;
    scene.objects = {{{300, 200}, {1, 0}, 20, 10, 0}, {{610, 300}, {1, 0}, 20, 10, 0}};
    std::vector<TimedState> states;
    for (int frame = 0; frame < 30; ++frame) {
        for (std::size_t i = 0; i < 2; ++i) {
            TrackState state = trueState(scene, i, frame, int(i) + 1);
            if (frame >= 20 || frame == 12) state.origin = StateOrigin::predicted;
            states.emplace_back(frame, state);
        }
    }
    const auto finished = finishTracks(states, summariesOf(scene, 30), {}, scene.scale);
    std::map<TrackId, int> last;
    std::map<TrackId, int> count;
    for (const auto& [frame, state] : finished) {
        last[state.id] = frame;
        ++count[state.id];
    }
    EXPECT_EQ(last[1], 19);
    EXPECT_EQ(count[1], 20) << "predictions in between stay";
    EXPECT_EQ(last[2], 29);

    scene.objects[0].velocity = {0.2, 0};  // 1.25 m/s
    states.clear();
    for (int frame = 0; frame < 30; ++frame) {
        states.emplace_back(frame, trueState(scene, 0, frame, 1));
        if (frame >= 20) states.back().second.origin = StateOrigin::predicted;
    }
    EXPECT_EQ(finishTracks(states, summariesOf(scene, 30), {}, scene.scale).size(), 30u) << "it stopped";
}

TEST(FinishTracks, fragmentsOfOneVehicleAreJoinedAndTheGapFilled) {
    const MovingScene scene = oneCar();
    std::vector<TimedState> states;
    for (int frame = 0; frame < 70; ++frame) {
        if (frame >= 20 && frame < 35) continue;
        TrackState state = trueState(scene, 0, frame, frame < 20 ? 3 : 9);
        state.hits = frame < 20 ? frame + 1 : frame - 34;
        states.emplace_back(frame, state);
    }
    const auto finished = finishTracks(states, summariesOf(scene, 70), {}, scene.scale);
    ASSERT_EQ(finished.size(), 70u);
    expectOrdered(finished);
    for (const auto& [frame, state] : finished) {
        EXPECT_EQ(state.id, 3);
        EXPECT_GT(overlap(state.box, scene.box(0, frame)), 0.95) << frame;
        EXPECT_EQ(state.age, frame);
    }
    EXPECT_EQ(finished.back().second.hits, 55);
    EXPECT_EQ(finished[25].second.origin, StateOrigin::predicted);

    FinishingOptions apart;
    apart.join_gap_s = 0.3;
    std::set<TrackId> ids;
    for (const auto& [frame, state] : finishTracks(states, summariesOf(scene, 70), apart, scene.scale)) {
        ids.insert(state.id);
    }
    EXPECT_EQ(ids.size(), 2u) << "the gap is longer than that";
}

TEST(FinishTracks, differentVehiclesAreNotJoined) {
    MovingScene scene;
    // Beside it, the other way, and of another size.
    scene.objects = {{{100, 100}, {2, 0}, 20, 10, 0},
                     {{100, 130}, {2, 0}, 20, 10, 0},
                     {{230, 100}, {-2, 0}, 20, 10, 0},
                     {{100, 100}, {2, 0}, 45, 14, 0}};
    for (std::size_t other = 1; other < 4; ++other) {
        std::vector<TimedState> states;
        for (int frame = 0; frame < 50; ++frame) {
            if (frame < 25) states.emplace_back(frame, trueState(scene, 0, frame, 1));
            if (frame >= 33) states.emplace_back(frame, trueState(scene, other, frame, 2));
        }
        std::set<TrackId> ids;
        for (const auto& [frame, state] : finishTracks(states, summariesOf(scene, 50), {}, scene.scale)) {
            ids.insert(state.id);
        }
        EXPECT_EQ(ids.size(), 2u) << other;
    }
}

TEST(FinishTracks, tracksAreExtendedBackOverTheGroundOnce) {
    const MovingScene scene = oneCar();
    std::vector<TimedState> states;
    for (int frame = 10; frame < 40; ++frame) states.emplace_back(frame, trueState(scene, 0, frame, 1));
    const auto summaries = summariesOf(scene, 40);
    auto finished = finishTracks(states, summaries, {}, scene.scale);
    ASSERT_EQ(finished.size(), 35u);
    EXPECT_EQ(finished.front().first, 5);
    EXPECT_EQ(finished.front().second.age, 0);
    EXPECT_EQ(finished.front().second.origin, StateOrigin::predicted);
    EXPECT_GT(overlap(finished.front().second.box, scene.box(0, 5)), 0.99);
    finished = finishTracks(finished, summaries, {}, scene.scale);
    EXPECT_EQ(finished.size(), 35u);
}

TEST(FinishTracks, extensionStopsAtTheBorderAndAtUnreliableFrames) {
    MovingScene scene;
    scene.objects = {{{20, 200}, {3, 0}, 20, 10, 0}};
    std::vector<TimedState> states;
    for (int frame = 3; frame < 20; ++frame) states.emplace_back(frame, trueState(scene, 0, frame, 1));
    auto summaries = summariesOf(scene, 20);
    EXPECT_EQ(finishTracks(states, summaries, {}, scene.scale).front().first, 0);
    scene.objects[0].start.x = 8;
    for (auto& [frame, state] : states) state = trueState(scene, 0, frame, 1);
    EXPECT_EQ(finishTracks(states, summaries, {}, scene.scale).front().first, 0)
        << "four fifths of the car are in the image";
    scene.objects[0].start.x = -4;
    for (auto& [frame, state] : states) state = trueState(scene, 0, frame, 1);
    EXPECT_EQ(finishTracks(states, summaries, {}, scene.scale).front().first, 2) << "half of the car is in the image";
    summaries[3].registration.state = RegistrationState::failed;
    EXPECT_EQ(finishTracks(states, summaries, {}, scene.scale).front().first, 3);
}

TEST(FinishTracks, vehiclesThatCameInOverTheBorderAreExtendedBackToIt) {
    MovingScene scene;
    scene.objects = {{{-10, 200}, {3, 0}, 20, 10, 0}, {{200, 100}, {3, 0}, 20, 10, 0}};
    std::vector<TimedState> states;
    for (int frame = 10; frame < 40; ++frame) {
        states.emplace_back(frame, trueState(scene, 0, frame, 1));
        states.emplace_back(frame, trueState(scene, 1, frame, 2));
    }
    std::map<TrackId, int> first;
    for (const auto& [frame, state] : finishTracks(states, summariesOf(scene, 40), {}, scene.scale)) {
        first.emplace(state.id, frame);
    }
    EXPECT_EQ(first[1], 4) << "half of it was in the image then";
    EXPECT_EQ(first[2], 5) << "far from the border nothing is known beyond extend_back";
}

TEST(FinishTracks, whatStaysSmallerThanAnyVehicleIsDroppedWhereTheScaleIsKnown) {
    MovingScene scene = oneCar();
    scene.objects.push_back({{300, 300}, {-1, 0.4}, 4, 2, 0});
    std::vector<TimedState> states;
    for (int frame = 0; frame < 30; ++frame) {
        for (std::size_t i = 0; i < 2; ++i) states.emplace_back(frame, trueState(scene, i, frame, int(i) + 1));
    }
    const auto idsAt = [&](SceneScale scale) {
        std::set<TrackId> ids;
        for (const auto& [frame, state] : finishTracks(states, summariesOf(scene, 30), {}, scale)) ids.insert(state.id);
        return ids;
    };
    EXPECT_EQ(idsAt({0.25, 25, true}), (std::set<TrackId>{1}));
    EXPECT_EQ(idsAt({0.25, 25, false}), (std::set<TrackId>{1, 2}));
}

TEST(FinishTracks, ofTwoTracksInOnePlaceTheOneDetectedLessOftenGivesWay) {
    MovingScene scene = oneCar();
    scene.objects.push_back({{256, 182}, {1.5, 0.8}, 16, 9, 0});  // on the same car
    scene.objects.push_back({{240, 195}, {1.5, 0.8}, 18, 8, 0});  // in the next lane
    std::vector<TimedState> states;
    for (int frame = 0; frame < 30; ++frame) {
        for (std::size_t i = 0; i < 3; ++i) {
            states.emplace_back(frame, trueState(scene, i, frame, int(i) + 1));
            if (i == 1 && frame % 2 == 1) states.back().second.origin = StateOrigin::reconstructed;
        }
    }
    std::set<TrackId> ids;
    for (const auto& [frame, state] : finishTracks(states, summariesOf(scene, 30), {}, scene.scale)) {
        ids.insert(state.id);
    }
    EXPECT_EQ(ids, (std::set<TrackId>{1, 3}));
}

/// Front and rear of a lorry, 14 px each, and a car behind it; px/frame.
std::vector<TimedState> lorryInParts(const MovingScene& scene, int frames) {
    std::vector<TimedState> states;
    for (int frame = 0; frame < frames; ++frame) {
        for (std::size_t i = 0; i < scene.objects.size(); ++i) {
            // The rear is found later.
            if (i == 1 && frame < 5) continue;
            states.emplace_back(frame, trueState(scene, i, frame, int(i) + 1));
        }
    }
    return states;
}

TEST(FinishTracks, partsThatDriveAsIfFixedAreOneLorry) {
    MovingScene scene;
    scene.objects = {{{250, 180}, {1.5, 0}, 14, 9, 0}, {{236, 180}, {1.5, 0}, 13, 9, 0}};
    const auto finished = finishTracks(lorryInParts(scene, 60), summariesOf(scene, 60), {}, scene.scale);
    ASSERT_EQ(finished.size(), 60U);
    const OrientedBox& box = finished[40].second.box;
    EXPECT_EQ(finished[40].second.id, 1);
    EXPECT_NEAR(box.length, 27.5, 0.6);  // 257 − 229.5
    EXPECT_NEAR(box.centre.x, 243.25 + 1.5 * 40, 0.6);
    EXPECT_NEAR(finished[2].second.box.length, 27.5, 0.6);
}

TEST(FinishTracks, aLorryIsAtMostTwentyMetresLong) {
    // 80 px. The rear is 13 px long and joins on.
    for (const auto& [length, expected] : {std::pair(66.0, 60U), {69.0, 115U}}) {
        MovingScene scene;
        scene.objects = {{{250, 180}, {1.5, 0}, length, 9, 0}, {{250 - (length + 13) / 2, 180}, {1.5, 0}, 13, 9, 0}};
        FinishingOptions options;
        options.extend_back = false;
        EXPECT_EQ(finishTracks(lorryInParts(scene, 60), summariesOf(scene, 60), options, scene.scale).size(), expected)
            << length;
    }
}

TEST(FinishTracks, carsThatFollowEachOtherStayTwo) {
    MovingScene close;  // as close, but the distance changes by half a metre and more
    close.objects = {{{250, 180}, {1.5, 0}, 14, 9, 0}, {{233, 180}, {1.62, 0}, 13, 9, 0}};
    EXPECT_EQ(finishTracks(lorryInParts(close, 60), summariesOf(close, 60), {}, close.scale).size(), 120U);
    MovingScene cars;  // fixed, but both as long as cars, and as slow as in dense traffic
    cars.objects = {{{250, 180}, {0.9, 0}, 18, 9, 0}, {{232, 180}, {0.9, 0}, 18, 9, 0}};
    EXPECT_EQ(finishTracks(lorryInParts(cars, 60), summariesOf(cars, 60), {}, cars.scale).size(), 120U);
    MovingScene slow;  // bumper to bumper
    slow.objects = {{{250, 180}, {0.3, 0}, 14, 9, 0}, {{236, 180}, {0.3, 0}, 13, 9, 0}};
    EXPECT_EQ(finishTracks(lorryInParts(slow, 60), summariesOf(slow, 60), {}, slow.scale).size(), 120U);
}

TEST(FinishTracks, aTrackWiderThanAVehicleDoesNotDriveOutThoseInIt) {
    MovingScene scene;
    scene.objects = {{{250, 180}, {1.5, 0}, 20, 20, 0}, {{250, 175}, {1.5, 0}, 18, 8, 0}};
    std::vector<TimedState> states;
    for (int frame = 0; frame < 30; ++frame) {
        for (std::size_t i = 0; i < 2; ++i) states.emplace_back(frame, trueState(scene, i, frame, int(i) + 1));
    }
    EXPECT_EQ(finishTracks(states, summariesOf(scene, 30), {}, scene.scale).size(), 60u);
}

TEST(FinishTracks, survivesMissingSummariesAndBrokenStates) {
    const MovingScene scene = oneCar();
    EXPECT_TRUE(finishTracks({}, {}, {}, scene.scale).empty());
    std::vector<TimedState> states;
    for (int frame = 0; frame < 30; ++frame) states.emplace_back(frame, trueState(scene, 0, frame, 1));
    states[4].second.box.centre.x = std::numeric_limits<double>::quiet_NaN();
    states.push_back(states[10]);
    auto finished = finishTracks(states, {}, {}, scene.scale);
    EXPECT_EQ(finished.size(), 29u);
    expectOrdered(finished);
    auto summaries = summariesOf(scene, 30);
    summaries[12].registration.current_from_previous.matrix = cv::Matx33d::zeros();
    summaries[20].registration.current_from_previous.matrix = cv::Matx33d::all(1e300);
    finished = finishTracks(states, summaries, {}, scene.scale);
    EXPECT_EQ(finished.size(), 29u);
    for (const auto& [frame, state] : finished) {
        EXPECT_TRUE(std::isfinite(state.box.centre.x) && std::isfinite(state.box.heading)) << frame;
        EXPECT_TRUE(std::isfinite(state.box.area())) << frame;
    }
}

TEST(FinishingOptions, areAllNamedAfterFinishing) {
    FinishingOptions options;
    const auto parameters = listParameters(describeOf(options));
    EXPECT_EQ(parameters.size(), 28u);
    for (const Parameter& parameter : parameters) EXPECT_EQ(parameter.name.rfind("finishing.", 0), 0u);
}

TEST(FinishTracks, statesComeByFrameWhicheverTrackBeganFirst) {
    MovingScene scene;
    scene.objects = {
        {{150, 80}, {1.5, 0}, 20, 10, 0}, {{150, 180}, {1.5, 0}, 20, 10, 0}, {{150, 280}, {1.5, 0}, 20, 10, 0}};
    const int first[] = {30, 0, 12};
    FinishingOptions options;
    options.extend_back = false;
    std::vector<TimedState> states;
    for (std::size_t i = 0; i < 3; ++i) {
        for (int frame = first[i]; frame < 60; ++frame)
            states.emplace_back(frame, trueState(scene, i, frame, int(i) + 1));
    }
    const auto finished = finishTracks(states, summariesOf(scene, 60), options, scene.scale);
    EXPECT_EQ(finished.size(), 30U + 60U + 48U);
    expectOrdered(finished);
}

TEST(FinishTracks, aVehicleThatDrivesPointsAlongItsPath) {
    // Measured askew by a tenth of a turn to the same side, over many of its lengths.
    const MovingScene scene = oneCar();
    std::vector<TimedState> states;
    for (int frame = 0; frame < 60; ++frame) {
        TrackState state = trueState(scene, 0, frame, 3);
        state.box.heading += 0.3;
        states.emplace_back(frame, state);
    }
    FinishingOptions options;
    options.smooth_window_s = 2;
    const auto askew = [&] {
        double worst = 0;
        for (const auto& [frame, state] : finishTracks(states, summariesOf(scene, 60), options, scene.scale)) {
            if (frame > 20 && frame < 40)
                worst = std::max(worst, std::abs(axisTurnBetween(scene.box(0, frame).heading, state.box.heading)));
        }
        return worst;
    };
    EXPECT_LT(askew(), 0.03);
    options.smooth_path = false;
    EXPECT_GT(askew(), 0.25);
}

}  // namespace eyrie::track_finishing_test
