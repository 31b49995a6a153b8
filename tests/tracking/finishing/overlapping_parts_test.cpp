// When finishing takes two tracks whose boxes lie on each other for one vehicle: every limit on both sides, whichever
// way the road goes.
#include <gtest/gtest.h>

#include <algorithm>

#include "tracking/finishing/lanes.h"
#include "tracking/frame_summaries.h"

namespace eyrie::overlapping_parts_test {
namespace {

using test::kFourToAMetre;
using test::Lane;
using test::onEveryRoad;
using test::shaking;

const SceneScale kEstimated{0.25, 25, false};

void expectOne(bool expected, const Lane& one, const Lane& other, const SceneScale& scale = kFourToAMetre,
               PartsOfVehicle wanted = PartsOfVehicle::overlapping) {
    test::expectParts(expected, one, other, scale, wanted);
}

/// A lorry seen from the side: its load, and its wheels, of which 1 px of 6 lies on the load.
struct Lorry {
    Lane load, wheels;
    Lorry() {
        load.size = {24, 8};
        wheels.size = {12, 6};
        wheels.offset = {-4, 6};
    }
};

}  // namespace

TEST(OverlappingParts, AreNoPartsInLine) {
    Lorry lorry;
    expectOne(true, lorry.load, lorry.wheels);
    expectOne(false, lorry.load, lorry.wheels, kFourToAMetre, PartsOfVehicle::in_line);
    lorry.wheels.offset = {-18, 0};  // right behind
    expectOne(false, lorry.load, lorry.wheels);
    expectOne(true, lorry.load, lorry.wheels, kFourToAMetre, PartsOfVehicle::in_line);
}

TEST(OverlappingParts, MakeOneBoxAroundBoth) {
    const Lorry lorry;
    onEveryRoad(lorry.load, lorry.wheels, [](std::vector<TrackPath> paths) {
        joinParts(paths, kFourToAMetre, PartsOfVehicle::overlapping);
        ASSERT_EQ(paths.size(), 1U);
        const OrientedBox& box = paths[0].states[10].second.box;
        EXPECT_NEAR(box.length, 24, 1e-3);
        EXPECT_NEAR(box.width, 13, 1e-3);  // from −4 to 9
    });
}

TEST(OverlappingParts, DoNotGrowTheBoxOfWhatIsWholeWhileAlone) {
    // A van in two parts for 30 frames; then the leader's box holds all of it, or remains the part that it was.
    Lane front, rear;
    front.size = {10, 8};
    front.count = 80;
    rear.size = {10, 8};
    rear.offset = {-11, 0};
    rear.count = 30;
    for (const double alone : {21.0, 12.0}) {
        onEveryRoad(front, rear, [&](std::vector<TrackPath> paths) {
            for (std::size_t i = 30; i < 80; ++i) paths[0].states[i].second.box.length = static_cast<float>(alone);
            joinParts(paths, kFourToAMetre, PartsOfVehicle::in_line);
            ASSERT_EQ(paths.size(), 1U);
            EXPECT_NEAR(paths[0].states[10].second.box.length, 21, 1e-3);
            EXPECT_NEAR(paths[0].states[60].second.box.length, alone == 21 ? 21 : 23, 1e-3);
        });
    }
}

TEST(OverlappingParts, GrowInMetresAsTheVehicleComesNearer) {
    // A van in two parts, of which the rear is seen while it is far; three times as near it is still no whole.
    SceneScale scale = kFourToAMetre;
    scale.slope = {0, 0.003, 320, 300};
    const auto part = [&](double y, double behind) {
        const double factor = scale.slope.factorAt({320, y});
        TrackState state;
        state.box = {{320, y - behind * factor}, 10 * factor, 8 * factor, CV_PI / 2};
        state.velocity = {0, 4};
        state.status = TrackStatus::confirmed;
        return PathState(state);
    };
    std::vector<TrackPath> paths{{1, {}}, {2, {}}};
    for (FrameIndex frame = 0; frame < 80; ++frame) {
        paths[0].states.emplace_back(frame, part(100 + 4 * frame, 0));
        if (frame < 30) paths[1].states.emplace_back(frame, part(100 + 4 * frame, 11));
    }
    joinParts(paths, scale, PartsOfVehicle::in_line);
    ASSERT_EQ(paths.size(), 1U);
    for (const std::size_t i : {10, 29, 60, 79}) {
        const double factor = scale.slope.factorAt({320, 100 + 4.0 * static_cast<double>(i)});
        EXPECT_NEAR(paths[0].states[i].second.box.length, 21 * factor, 0.12 * factor * 21) << i;
    }
}

TEST(OverlappingParts, ShareATenthOfTheSmaller) {
    Lorry lorry;
    for (const double side : {-1.0, 1.0}) {
        for (const double aside : {6.38, 6.42}) {  // 7 less .6 of 6 px
            lorry.wheels.offset = {-4, aside * side};
            expectOne(aside < 6.4, lorry.load, lorry.wheels);
        }
    }
}

TEST(OverlappingParts, HaveDrivenFourMetresFasterThanQueues) {
    Lorry lorry;
    lorry.load.speed = lorry.wheels.speed = 0.5;
    for (const int together : {33, 31}) {  // 16 px
        lorry.wheels.count = together;
        expectOne(together == 33, lorry.load, lorry.wheels);
    }
    lorry.load.count = lorry.wheels.count = 120;
    for (const double speed : {0.41, 0.39}) {  // 2.5 m/s are .4
        lorry.load.speed = lorry.wheels.speed = speed;
        expectOne(speed > 0.4, lorry.load, lorry.wheels);
    }
}

TEST(OverlappingParts, AreSeenTogetherForAQuarterOfTheLongerLife) {
    // The box of the whole life grows by what was seen in that quarter.
    Lorry lorry;
    lorry.load.count = 100;
    lorry.wheels.count = 60;
    for (const int together : {25, 24}) {
        lorry.wheels.first = 100 - together;
        expectOne(together == 25, lorry.load, lorry.wheels);
    }
}

TEST(OverlappingParts, ScatterByHalfAMetreAtMost) {
    // 1.48 times the median of 0 and 2 a is at most .5 m and half a px: a = .843 px.
    Lorry lorry;
    for (const double a : {0.83, 0.86}) {
        lorry.wheels.wobble = shaking({a, 0});
        expectOne(a < 0.84, lorry.load, lorry.wheels);
    }
}

TEST(OverlappingParts, WidenNoVehicleAndMayBeAQuarterLargerWhereTheScaleIsAGuess) {
    Lorry lorry;
    for (const double width : {16.3, 16.5}) {  // 3.6 m and two px
        lorry.load.size.height = width;
        lorry.wheels.offset = {-4, 0};
        expectOne(width < 16.4, lorry.load, lorry.wheels);
        expectOne(true, lorry.load, lorry.wheels, kEstimated);
    }
    for (const double width : {19.9, 20.1}) {
        lorry.load.size.height = width;
        expectOne(width < 20, lorry.load, lorry.wheels, kEstimated);
    }
    lorry = {};
    for (const double length : {14.3, 14.5}) {  // shorter than any car: 3.6 m
        lorry.wheels.size.width = length;
        expectOne(length < 14.4, lorry.load, lorry.wheels);
        expectOne(true, lorry.load, lorry.wheels, kEstimated);
    }
    for (const double length : {17.9, 18.1}) {
        lorry.wheels.size.width = length;
        expectOne(length < 18, lorry.load, lorry.wheels, kEstimated);
    }
}

TEST(OverlappingParts, AreJoinedOnceShadowsAreGone) {
    // What is hardly ever detected beside a car is its shadow, and no part of it.
    Lane car, shadow;
    car.size = {18, 8};
    shadow.size = {14, 6};
    shadow.offset = {3, 6};
    shadow.detected = 12;
    shadow.id = 2;
    std::vector<TimedState> states;
    for (const Lane& lane : {car, shadow}) {
        for (const auto& [frame, at] : lane.path().states) {
            TrackState state;
            state.id = lane.id;
            state.box = at.box;
            state.velocity = at.velocity;
            state.status = at.status;
            state.origin = at.origin;
            state.hits = 40;
            states.emplace_back(frame, state);
        }
    }
    std::stable_sort(states.begin(), states.end(),
                     [](const TimedState& a, const TimedState& b) { return a.first < b.first; });
    std::vector<FrameMotionSummary> motion;
    for (int frame = 0; frame < 40; ++frame) motion.push_back(test::summaryOfFrame(frame));
    for (const auto& [frame, state] : finishTracks(states, motion, {}, kFourToAMetre, {})) {
        EXPECT_EQ(state.id, 1);
        EXPECT_NEAR(state.box.width, 8, 0.5) << frame;
    }
}

}  // namespace eyrie::overlapping_parts_test
