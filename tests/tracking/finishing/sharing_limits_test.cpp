// Which of two tracks in one place gives way, and what is no track of a vehicle: every limit on both sides.
#include <gtest/gtest.h>

#include "tracking/finishing/lanes.h"

namespace eyrie::sharing_limits_test {
namespace {

using test::kFourToAMetre;
using test::Lane;
using test::onEveryRoad;
using test::shaking;

int statesOf(const std::vector<TrackPath>& paths, TrackId id) {
    for (const TrackPath& path : paths) {
        if (path.id == id) return static_cast<int>(path.states.size());
    }
    return 0;
}

/// States left of the second of two tracks that lie on each other.
void expectLeft(int expected, const Lane& stronger, const Lane& weaker, double max_sharing = 0.5) {
    onEveryRoad(stronger, weaker, [&](std::vector<TrackPath> paths) {
        DropList dropped;
        std::size_t all = 0, told = 0;
        for (const TrackPath& path : paths) all += path.states.size();
        dropSharers(paths, max_sharing, kFourToAMetre, dropped);
        EXPECT_EQ(statesOf(paths, 2), expected);
        for (const TrackPath& path : paths) told += path.states.size();
        for (const DroppedPath& drop : dropped) {
            told += drop.path.states.size();
            EXPECT_EQ(drop.why, TrackDrop::shares_place);
            EXPECT_EQ(drop.beside, 1);
        }
        EXPECT_EQ(told, all) << "what is left out is told";
    });
}

}  // namespace

TEST(DropSharers, TheOneDetectedLessOftenGivesWayWhereTheyShareMoreThanIsAllowed) {
    Lane car, other;
    other.detected = 30;
    other.size = {16, 8};
    // It creeps over the car, so they are not fixed: half of it in the middle of its life, d px of 16.
    const auto creeping = [](double shared) {
        return [shared](int frame) { return cv::Point2d(18 - shared + 0.2 * (frame - 19.5), 0); };
    };
    other.wobble = creeping(8.4);
    expectLeft(0, car, other);
    other.wobble = creeping(7.6);
    expectLeft(40, car, other);
    // What is left is most of its life.
    other.count = 130;
    other.detected = 30;
    other.wobble = [](int frame) { return cv::Point2d(0.2 * (frame - 19.5), frame < 40 ? 0 : 40); };
    car.count = 40;
    expectLeft(90, car, other);
    for (const int count : {81, 79, 66}) {  // of a life that is shared for 40 frames
        other.count = count;
        expectLeft(count == 81 ? 41 : 0, car, other);
    }
}

TEST(DropSharers, NeedFiveFramesAndThreeTenthsOfTheShorterLife) {
    Lane car, other;
    other.detected = 30;
    for (const int together : {5, 4}) {
        other.first = 40 - together;
        other.count = 10;
        other.detected = 10;
        expectLeft(together == 5 ? 5 : 10, car, other);
    }
    for (const int together : {13, 11}) {
        other.first = 40 - together;
        other.count = 40;
        other.detected = 30;
        expectLeft(together == 13 ? 27 : 40, car, other);
    }
}

TEST(DropSharers, PartsThatKeepTheirPlaceNeedToShareLess) {
    // .35 of .5 of 16 × 8 px: 2.8 of 16 px along.
    Lane car, other;
    other.detected = 30;
    other.size = {16, 8};
    for (const double shared : {2.9, 2.7}) {
        other.offset = {18 - shared, 0};
        expectLeft(shared > 2.8 ? 0 : 40, car, other);
    }
    other.offset = {14, 0};
    // Fixed to .15 m and .2 px: 1.48 · 2 a = .8.
    for (const double a : {0.26, 0.28}) {
        other.wobble = shaking({a, 0});
        expectLeft(a < 0.27 ? 0 : 40, car, other);
        other.wobble = shaking({0, a});
        expectLeft(a < 0.27 ? 0 : 40, car, other);
    }
    // … for eight tenths of the shorter life and .4 s.
    other.wobble = nullptr;
    for (const int together : {33, 31}) {
        other.first = 40 - together;
        expectLeft(together == 33 ? 0 : 40, car, other);
    }
    for (const int together : {10, 9}) {
        other.first = 0;
        other.count = other.detected = together;
        expectLeft(together == 10 ? 0 : 9, car, other);
    }
}

TEST(DropSharers, AboxWiderThanAVehicleHoldsOnlyOnesOfLikeSize) {
    // 3.2 m and one px are 13.8 px.
    Lane wide, car;
    car.detected = 30;
    for (const double width : {13.7, 13.9}) {
        wide.size = {20, width};
        expectLeft(width < 13.8 ? 0 : 40, wide, car, 0.6);
    }
    // The larger of the two boxes is the one that may hold others.
    Lane small;
    small.size = {12, 8};
    Lane large = car;
    large.size = {20, 20};
    large.detected = 30;
    expectLeft(40, small, large, 0.6);
    wide.size = {20, 20};
    car.size = {18, 18};
    expectLeft(0, wide, car, 0.6);
}

TEST(DropSharers, NothingIsSharedAtAShareOfOne) {
    Lane car, other;
    other.detected = 30;
    expectLeft(40, car, other, 1);
}

TEST(DropTooSmall, ThreeQuartersOfTheBoxesAreSmaller) {
    // Of 41 frames the 31st smallest decides; 1.8 m are 7.2 px.
    FinishingOptions options;
    options.min_length_m = 1.8;
    options.min_width_m = 0.8;
    for (const int large : {10, 11}) {
        Lane lane;
        lane.count = 41;
        lane.size = {7, 5};
        std::vector<TrackPath> paths{lane.path()};
        for (int i = 0; i < large; ++i) paths[0].states[std::size_t(3 * i)].second.box.length = 7.4F;
        DropList dropped;
        dropTooSmall(paths, options, kFourToAMetre, dropped);
        EXPECT_EQ(paths.size(), large == 11 ? 1U : 0U);
    }
    for (const double share : {0.99, 1.01}) {
        for (const bool known : {true, false}) {
            const SceneScale scale{0.2, 25, known};  // an estimate counts by eight tenths
            Lane lane;
            lane.size = {9 * share * (known ? 1 : 0.8), 8};
            std::vector<TrackPath> paths{lane.path()};
            DropList dropped;
            dropTooSmall(paths, options, scale, dropped);
            EXPECT_EQ(paths.empty(), share < 1);
            lane.size = {20, 4 * share * (known ? 1 : 0.8)};
            paths = {lane.path()};
            dropTooSmall(paths, options, scale, dropped);
            EXPECT_EQ(paths.empty(), share < 1);
        }
    }
}

TEST(DropHardlyDetectedLimits, AreAShareOrFourTenthsOfASecond) {
    const auto stays = [](int detected, int count, StateOrigin otherwise) {
        Lane lane;
        lane.count = count;
        lane.detected = detected;
        lane.otherwise = otherwise;
        std::vector<TrackPath> paths{lane.path()};
        DropList dropped;
        dropHardlyDetected(paths, 0.5, kFourToAMetre, dropped);
        EXPECT_EQ(dropped.size(), paths.empty() ? 1U : 0U);
        return !paths.empty();
    };
    EXPECT_TRUE(stays(9, 18, StateOrigin::reconstructed));
    EXPECT_FALSE(stays(9, 19, StateOrigin::reconstructed));
    EXPECT_TRUE(stays(10, 100, StateOrigin::reconstructed));
    EXPECT_TRUE(stays(2, 100, StateOrigin::predicted));
    EXPECT_TRUE(stays(2, 100, StateOrigin::standing));
}

}  // namespace eyrie::sharing_limits_test
