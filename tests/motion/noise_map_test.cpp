#include "motion/vectors/noise_map.h"

#include <gtest/gtest.h>

#include <cstdlib>

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
    NoiseMap crowded({400, 200}, 0);
    for (int i = 0; i < 100; ++i) crowded.add({200, 100}, 0.5);
    crowded.finish();
    EXPECT_EQ(crowded.at({200, 100}), 1);
}

/// 60 still corners at one place of a picture of 500 × 300 px.
NoiseMap crowdAt(cv::Point2f place, double cell) {
    NoiseMap map({500, 300}, cell);
    for (int i = 0; i < 60; ++i) map.add(place, 0.5);
    map.finish();
    return map;
}

TEST(NoiseMap, CornersCountInTheirCellAndTheEightAroundIt) {
    for (const cv::Point crowd : {cv::Point(2, 1), {0, 0}, {4, 2}, {4, 0}}) {
        const NoiseMap map = crowdAt(crowd * 100 + cv::Point(50, 50), 0.2);  // cells of 100 px
        for (int y = 0; y < 3; ++y) {
            for (int x = 0; x < 5; ++x) {
                const bool near = std::abs(x - crowd.x) <= 1 && std::abs(y - crowd.y) <= 1;
                EXPECT_EQ(map.at(cv::Point(x, y) * 100 + cv::Point(99, 1)), near ? 0.5 : 1) << x << ", " << y;
            }
        }
    }
    EXPECT_EQ(crowdAt({50, 250}, 0.2).at({50, 5000}), 0.5) << "below the picture";
}

TEST(NoiseMap, CellsAreNeverSmallerThanFourPixels) {
    const NoiseMap map = crowdAt({9, 9}, 0.001);  // in the third cell of either axis
    EXPECT_EQ(map.at({4, 4}), 0.5);
    EXPECT_EQ(map.at({3.9F, 4}), 1);
    EXPECT_EQ(map.at({15.9F, 15.9F}), 0.5);
    EXPECT_EQ(map.at({15.9F, 16}), 1);
}

}  // namespace
}  // namespace eyrie::noise_map_test
