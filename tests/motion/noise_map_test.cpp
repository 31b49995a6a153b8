#include "motion/vectors/noise_map.h"

#include <gtest/gtest.h>

namespace eyrie::noise_map_test {
namespace {

/// Every corner of a grid, ten px apart, over a picture of 400 × 200 px; `speed` says how much of the usual speed it
/// shows.
template <class Speed>
NoiseMap mapOf(double cell, Speed speed) {
    NoiseMap map({400, 200}, cell);
    for (int y = 5; y < 200; y += 10) {
        for (int x = 5; x < 400; x += 10) map.add(cv::Point2f(float(x), float(y)), speed(x, y));
    }
    map.finish();
    return map;
}

TEST(NoiseMap, AStillRoadIsTrustedMoreThanTheReliefBesideIt) {
    const NoiseMap map = mapOf(0.25, [](int x, int) { return x < 200 ? 0.5 : 1.6; });
    EXPECT_FLOAT_EQ(map.at({50, 100}), 0.5);
    EXPECT_FLOAT_EQ(map.at({150, 100}), 0.5);  // two cells of three are road
    EXPECT_EQ(map.at({350, 100}), 1);          // never noisier than the whole
}

TEST(NoiseMap, WhatMovesOnTheRoadDoesNotMakeItNoisy) {
    const NoiseMap map = mapOf(0.25, [](int x, int y) { return (x + y) / 10 % 3 == 0 ? 40.0 : 0.5; });
    EXPECT_FLOAT_EQ(map.at({200, 100}), 0.5);
}

TEST(NoiseMap, WhatMayBeChanceDoesNotCount) {
    EXPECT_EQ(mapOf(0.25, [](int, int) { return 0.82; }).at({200, 100}), 1);
    EXPECT_FLOAT_EQ(mapOf(0.25, [](int, int) { return 0.78; }).at({200, 100}), 0.78);
}

TEST(NoiseMap, NeverBelowWhatCornersCanBeMeasuredTo) {
    const NoiseMap map = mapOf(0.25, [](int, int) { return 0.01; });
    EXPECT_EQ(map.at({200, 100}), 0.3);
}

TEST(NoiseMap, CellsWithFewCornersAroundTakeThatOfTheWhole) {
    NoiseMap map({400, 200}, 0.25);
    for (int i = 0; i < 59; ++i) map.add({50, 50}, 0.5);
    for (int i = 0; i < 60; ++i) map.add({350, 50}, 0.5);
    map.finish();
    EXPECT_EQ(map.at({50, 50}), 1);
    EXPECT_FLOAT_EQ(map.at({350, 50}), 0.5);
    EXPECT_FLOAT_EQ(map.at({299, 150}), 0.5);  // a neighbour, also across
    EXPECT_EQ(map.at({99, 50}), 1);
}

TEST(NoiseMap, PlacesOutsideThePictureTakeTheNearestCell) {
    const NoiseMap map = mapOf(0.25, [](int x, int) { return x < 200 ? 0.5 : 1.6; });
    EXPECT_FLOAT_EQ(map.at({-30, -30}), 0.5);
    EXPECT_EQ(map.at({500, 500}), 1);
}

TEST(NoiseMap, WithoutCellsTheNoiseIsTheSameEverywhere) {
    const NoiseMap map = mapOf(0, [](int, int) { return 0.5; });
    EXPECT_EQ(map.at({200, 100}), 1);
}

}  // namespace
}  // namespace eyrie::noise_map_test
