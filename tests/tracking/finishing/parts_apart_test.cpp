// When a track may be a part of the vehicle of another from which it lies apart: every limit on both sides, whichever
// way the road goes.
#include <gtest/gtest.h>

#include "tracking/finishing/lanes.h"

namespace eyrie::parts_apart_test {
namespace {

using test::kFourToAMetre;
using test::Lane;
using test::onEveryRoad;
using test::shaking;

/// The cab of a lorry, 4 m, and what is followed of its rear, 9 m behind.
struct Lorry {
    Lane cab, rear;
    double score = 0.5;
    Lorry() {
        cab.size = {16, 8};
        rear.size = {12, 8};
        rear.offset = {-36, 0};
    }
    bool mayBeOne() const {
        int yes = 0;
        int asked = 0;
        onEveryRoad(cab, rear, [&](std::vector<TrackPath> paths) {
            for (auto& [frame, state] : paths[1].states) state.score = static_cast<float>(score);
            ++asked;
            const PartsByTrack parts = partsBeside(paths, kFourToAMetre);
            yes += parts.contains(1) && parts.at(1).contains(2) ? 1 : 0;
        });
        EXPECT_TRUE(yes == 0 || yes == asked);
        return yes > 0;
    }
};

}  // namespace

TEST(PartsApart, MayLieAnywhereInTheLengthAndWidthOfALorry) {
    Lorry lorry;
    EXPECT_TRUE(lorry.mayBeOne());
    lorry.rear.offset = {-65, 0};  // 16.25 m and half of both
    EXPECT_TRUE(lorry.mayBeOne());
    lorry.rear.offset = {-67, 0};
    EXPECT_FALSE(lorry.mayBeOne()) << "more than 20 m in all";
    // 2.8 m, and a pixel.
    lorry.rear.offset = {-36, 12};
    EXPECT_TRUE(lorry.mayBeOne());
    lorry.rear.offset = {-36, 12.5};
    EXPECT_FALSE(lorry.mayBeOne()) << "in the next lane";
}

TEST(PartsApart, AreToldWithTheirPlaces) {
    Lorry lorry;
    lorry.rear.offset = {-36, 6};
    onEveryRoad(lorry.cab, lorry.rear, [](std::vector<TrackPath> paths) {
        for (auto& [frame, state] : paths[0].states) state.score = 0.9F;
        const PartsByTrack parts = partsBeside(paths, kFourToAMetre);
        ASSERT_EQ(parts.size(), 1U) << "the cab is no part of the rear: it is surely a vehicle";
        EXPECT_NEAR(parts.at(1).at(2).x, -9, 1e-3);
        EXPECT_NEAR(parts.at(1).at(2).y, 1.5, 1e-3);
    });
}

TEST(PartsApart, AreNoSureVehicles) {
    Lorry lorry;
    lorry.score = 0.79;
    EXPECT_TRUE(lorry.mayBeOne());
    lorry.score = 0.81;
    EXPECT_FALSE(lorry.mayBeOne());
    EXPECT_TRUE(partsBeside({lorry.cab.path()}, kFourToAMetre).empty()) << "nobody is a part of himself";
}

TEST(PartsApart, KeepTheirDistanceOnAWayThatSaysSomething) {
    Lorry lorry;
    // Half a metre, and half a pixel: 1.48 times how far it goes from side to side.
    lorry.rear.wobble = shaking({0.82, 0});
    EXPECT_TRUE(lorry.mayBeOne());
    lorry.rear.wobble = shaking({0.87, 0});
    EXPECT_FALSE(lorry.mayBeOne());
    lorry.rear.wobble = nullptr;
    // 8 m in 40 frames are .8 px a frame; 2.5 m/s are .4.
    for (Lane* lane : {&lorry.cab, &lorry.rear}) lane->speed = 0.82;
    EXPECT_TRUE(lorry.mayBeOne());
    for (Lane* lane : {&lorry.cab, &lorry.rear}) lane->speed = 0.78;
    EXPECT_FALSE(lorry.mayBeOne());
    for (Lane* lane : {&lorry.cab, &lorry.rear}) lane->speed = 1.7;
    for (Lane* lane : {&lorry.cab, &lorry.rear}) lane->count = 20;
    EXPECT_TRUE(lorry.mayBeOne());
    for (Lane* lane : {&lorry.cab, &lorry.rear}) lane->count = 19;
    EXPECT_FALSE(lorry.mayBeOne()) << "less than .8 s";
}

}  // namespace eyrie::parts_apart_test
