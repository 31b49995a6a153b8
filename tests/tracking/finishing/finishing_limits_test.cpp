// When finishing takes two tracks for one vehicle or for it and its shadow: every limit on both sides, whichever way
// the road goes.
#include <gtest/gtest.h>

#include <cmath>

#include "tracking/finishing/lanes.h"

namespace eyrie::finishing_limits_test {
namespace {

using test::kFourToAMetre;
using test::Lane;
using test::onEveryRoad;
using test::shaking;

void expectParts(bool expected, const Lane& leader, const Lane& other, const SceneScale& scale = kFourToAMetre) {
    test::expectParts(expected, leader, other, scale, PartsOfVehicle::in_line);
}

/// Front and rear of a lorry; the rear is 12 px long.
struct Lorry {
    Lane front, rear;
    Lorry() {
        front.size = {16, 9};
        rear.size = {12, 9};
        rear.offset = {-14, 0};
    }
};

void expectShadow(bool expected, const Lane& vehicle, const Lane& shadow, const SceneScale& scale = kFourToAMetre) {
    onEveryRoad(vehicle, shadow, [&](std::vector<TrackPath> paths) {
        DropList dropped;
        dropShadows(paths, scale, dropped);
        EXPECT_EQ(paths.size() == 1, expected);
        EXPECT_EQ(dropped.size(), expected ? 1U : 0U);
        if (!expected || dropped.empty()) return;
        EXPECT_EQ(dropped[0].path.id, 2);
        EXPECT_EQ(dropped[0].beside, 1);
        EXPECT_EQ(dropped[0].why, TrackDrop::shadow);
    });
}

/// A car and a shadow 1 px beside it that is detected in less than half as many frames.
struct CarAndShadow {
    Lane car, shadow;
    CarAndShadow() {
        shadow.offset = {3, 9};
        shadow.detected = 19;
    }
};

}  // namespace

TEST(JoinParts, AreSeenTogetherForEightTenthsOfASecond) {
    Lorry lorry;
    expectParts(true, lorry.front, lorry.rear);
    lorry.front.speed = lorry.rear.speed = 2;
    for (const int together : {20, 19}) {
        lorry.rear.first = 40 - together;
        lorry.rear.count = together;
        expectParts(together == 20, lorry.front, lorry.rear);
    }
    // Half of the shorter one's life.
    lorry.front.count = lorry.rear.count = 60;
    for (const int together : {31, 29}) {
        lorry.rear.first = 60 - together;
        expectParts(together == 31, lorry.front, lorry.rear);
    }
    lorry = {};
    // Of few frames a second, five.
    const SceneScale slow{0.25, 4, true};
    for (const int together : {5, 4}) {
        lorry.front.speed = lorry.rear.speed = 9;
        lorry.rear.first = 40 - together;
        lorry.rear.count = together;
        expectParts(together == 5, lorry.front, lorry.rear, slow);
    }
}

TEST(JoinParts, HaveDrivenEightMetresAndFasterThanQueues) {
    Lorry lorry;
    for (const double speed : {0.82, 0.78}) {  // 40 frames: 32 px
        lorry.front.speed = lorry.rear.speed = speed;
        expectParts(speed > 0.8, lorry.front, lorry.rear);
    }
    for (const double speed : {0.41, 0.39}) {  // 2.5 m/s are .4
        lorry.front.speed = lorry.rear.speed = speed;
        lorry.front.count = lorry.rear.count = 120;
        expectParts(speed > 0.4, lorry.front, lorry.rear);
    }
}

TEST(JoinParts, LieCloseBehindEachOther) {
    Lorry lorry;
    for (const double side : {-1.0, 1.0}) {
        for (const double gap : {3.3, 3.5}) {  // .6 m and one px
            lorry.rear.offset = {(14 + gap) * side, 0};
            expectParts(gap < 3.4, lorry.front, lorry.rear);
        }
        for (const double aside : {4.9, 5.1}) {  // 1 m and one px
            lorry.rear.offset = {14, aside * side};
            expectParts(aside < 5, lorry.front, lorry.rear);
        }
    }
}

TEST(JoinParts, OneOfThemIsShorterThanAnyCar) {
    Lorry lorry;
    lorry.front.speed = lorry.rear.speed = 0.95;  // so slow that it might be two cars
    for (const double length : {14.3, 14.5}) {    // 3.6 m are 14.4 px
        lorry.rear.size.width = length;
        lorry.front.size.width = 40;
        lorry.rear.offset = {-(40 + length) / 2, 0};
        expectParts(length < 14.4, lorry.front, lorry.rear);
        std::swap(lorry.front.size, lorry.rear.size);
        expectParts(length < 14.4, lorry.front, lorry.rear);
        std::swap(lorry.front.size, lorry.rear.size);
    }
}

/// Front and rear of a bus, 5 m each, of 11.5 m, at 9.4 m/s.
struct Bus {
    Lane front, rear;
    explicit Bus(double gap = 6) { rear.offset = {-20 - gap, 0}; }
};

TEST(JoinParts, OfABusLieCloserBehindEachOtherThanDriversDare) {
    expectParts(true, Bus().front, Bus().rear);
    for (const double gap : {6.7, 6.8, -3.9, -4.1}) {  // .18 s are 6.75 px, a metre 4
        const Bus bus(gap);
        expectParts(gap > -4 && gap < 6.75, bus.front, bus.rear);
    }
    for (const double speed : {0.97, 0.95}) {  // 6 m/s are .96
        Bus bus(4);
        bus.front.speed = bus.rear.speed = speed;
        bus.front.count = bus.rear.count = 60;
        expectParts(speed > 0.96, bus.front, bus.rear);
    }
}

TEST(JoinParts, OfABusAreAsLongAsOneAndFollowedTogether) {
    for (const double length : {15.0, 14.0, 26.0, 25.0}) {  // with a gap of 5 px 8.5 m are 34, 14 m are 56
        Bus bus(5);
        bus.front.size.width = bus.rear.size.width = length;
        bus.rear.offset = {-length - 5, 0};
        expectParts(length == 15 || length == 25, bus.front, bus.rear);
    }
    for (const int together : {31, 29}) {  // of 40, three quarters are 30
        Bus bus;
        bus.rear.first = 40 - together;
        bus.rear.count = together;
        expectParts(together == 31, bus.front, bus.rear);
    }
}

TEST(JoinParts, KeepTheirDistance) {
    // 1.48 times the median of 0 and 2 a is at most .35 m and half a px: a = .642 px.
    Lorry lorry;
    for (const double a : {0.63, 0.66}) {
        lorry.rear.wobble = shaking({a, 0});
        expectParts(a < 0.64, lorry.front, lorry.rear);
    }
}

TEST(JoinParts, PointTheSameWay) {
    Lorry lorry;
    for (const double turn : {0.34, -0.34, 0.36, -0.36}) {
        lorry.rear.turn = [turn](int) { return turn; };
        expectParts(std::abs(turn) < 0.35, lorry.front, lorry.rear);
    }
}

TEST(JoinParts, AreTogetherAtMostTwentyMetresLongAndWidenNoLorry) {
    Lorry lorry;
    for (const double length : {67.9, 68.1}) {  // and 12 px: 80
        lorry.front.size.width = length;
        lorry.rear.offset = {-(length + 12) / 2, 0};
        expectParts(length < 68, lorry.front, lorry.rear);
    }
    Lorry wide;
    for (const double width : {16.3, 16.5}) {  // 3.6 m and two px
        wide.rear.size.height = width;
        expectParts(width < 16.4, wide.front, wide.rear);
    }
}

TEST(JoinParts, OfDifferentLivesMakeOneTrackOfTheWholeSizeThroughout) {
    Lorry lorry;
    lorry.front.count = 50;
    lorry.rear.first = 10;
    lorry.rear.count = 45;
    lorry.rear.offset = {-14, 1.5};
    lorry.rear.size.height = 8;
    onEveryRoad(lorry.front, lorry.rear, [&](std::vector<TrackPath> paths) {
        const double heading = paths[0].states[0].second.box.heading;
        joinParts(paths, kFourToAMetre, PartsOfVehicle::in_line);
        ASSERT_EQ(paths.size(), 1U);
        EXPECT_EQ(paths[0].id, 1);
        ASSERT_EQ(paths[0].states.size(), 55U) << "each frame once";
        for (int frame = 0; frame < 55; ++frame) {
            const auto& [at, state] = paths[0].states[std::size_t(frame)];
            EXPECT_EQ(at, frame);
            // From −20 to 8 along, from −4.5 to 5.5 across.
            const OrientedBox road{{300, 200}, 1, 1, heading};
            const cv::Point2d place = road.toBox(state.box.centre);
            EXPECT_NEAR(state.box.length, 28, 1e-3) << frame;
            EXPECT_NEAR(state.box.width, 10, 1e-3) << frame;
            EXPECT_NEAR(place.x, 1.5 * frame - 6, 1e-3) << frame;
            EXPECT_NEAR(place.y, 0.5, 1e-3) << frame;
        }
    });
}

TEST(JoinParts, ThreeOfThemAreOneVehicle) {
    Lorry lorry;
    Lane last = lorry.rear;
    last.id = 3;
    last.offset = {-26.5, 0};
    lorry.rear.id = 2;
    std::vector<TrackPath> paths{lorry.front.path(), last.path(), lorry.rear.path()};
    joinParts(paths, kFourToAMetre, PartsOfVehicle::in_line);
    ASSERT_EQ(paths.size(), 1U);
    EXPECT_NEAR(paths[0].states[20].second.box.length, 40.5, 1e-3);
}

TEST(DropShadowsLimits, AreSeenTogetherForHalfASecondAndMostOfTheShadowsLife) {
    CarAndShadow scene;
    expectShadow(true, scene.car, scene.shadow);
    for (const int together : {13, 12}) {
        scene.shadow.count = together;
        scene.shadow.detected = 5;
        expectShadow(together == 13, scene.car, scene.shadow);
    }
    scene = {};
    for (const int first : {7, 9}) {  // 33 and 31 of 40 frames
        scene.shadow.first = first;
        scene.shadow.count = 40;
        expectShadow(first == 7, scene.car, scene.shadow);
    }
}

TEST(DropShadowsLimits, ShadowsAreDetectedLessThanHalfAsOften) {
    CarAndShadow scene;
    for (const int detected : {19, 20}) {
        scene.shadow.detected = detected;
        expectShadow(detected == 19, scene.car, scene.shadow);
    }
}

TEST(DropShadowsLimits, HaveDrivenFourMetresAndFasterThanQueues) {
    CarAndShadow scene;
    for (const double speed : {0.41, 0.39}) {
        scene.car.speed = scene.shadow.speed = speed;
        scene.car.count = 60;
        scene.shadow.count = 50;
        expectShadow(speed > 0.4, scene.car, scene.shadow);
    }
    for (const double speed : {0.81, 0.79}) {  // 20 frames: 16 px
        scene.car.speed = scene.shadow.speed = speed;
        scene.shadow.count = 20;
        expectShadow(speed > 0.8, scene.car, scene.shadow);
    }
}

TEST(DropShadowsLimits, MoveAlikeByATenthOfTheSpeed) {
    CarAndShadow scene;
    for (const double factor : {1.09, 0.91, 1.11, 0.89}) {
        scene.shadow.velocity_factor = factor;
        expectShadow(std::abs(factor - 1) < 0.1, scene.car, scene.shadow);
    }
}

TEST(DropShadowsLimits, LieBesideTheVehicleAndTouchIt) {
    CarAndShadow scene;
    for (const double side : {-1.0, 1.0}) {
        for (const double across : {9.3, 9.5}) {  // 8 px, .3 m and .2 px
            scene.shadow.offset = {3, across * side};
            expectShadow(across < 9.4, scene.car, scene.shadow);
        }
        for (const double along : {19.9, 20.1}) {
            scene.shadow.offset = {along * side, 5};
            expectShadow(along < 20, scene.car, scene.shadow);
        }
    }
    scene.car.size = {30, 8};
    scene.shadow.size = {10, 4};
    scene.shadow.offset = {19, 7.3};
    expectShadow(true, scene.car, scene.shadow);
    scene.shadow.offset = {19, 7.5};
    expectShadow(false, scene.car, scene.shadow);
}

TEST(DropShadowsLimits, KeepTheirPlaces) {
    CarAndShadow scene;
    for (const double a : {0.66, 0.69}) {  // 1.48 · 2 a ≤ .5 m
        scene.shadow.wobble = shaking({0, a});
        scene.shadow.offset = {3, 8};
        expectShadow(a < 0.675, scene.car, scene.shadow);
    }
    for (const double a : {2.0, 2.06}) {  // ≤ 1.5 m
        scene.shadow.wobble = shaking({a, 0});
        expectShadow(a < 2.03, scene.car, scene.shadow);
    }
}

}  // namespace eyrie::finishing_limits_test
