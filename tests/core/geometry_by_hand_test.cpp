#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "core/geometry/homography.h"
#include "core/geometry/local_plane.h"
#include "core/geometry/oriented_box.h"
#include "core/geometry/sound_map.h"

/// Maps, boxes and places, worked out by hand.
namespace eyrie::geometry_by_hand_test {
namespace {

Homography mapOf(const cv::Matx33d& matrix, FrameIndex from = 0, FrameIndex to = 1) {
    Homography map;
    map.matrix = matrix;
    map.from_frame = from;
    map.to_frame = to;
    return map;
}

TEST(HomographyByHand, APointIsDividedByItsDepth) {
    const cv::Point2d p = mapOf({1, 2, 3, 4, 5, 6, 0.1, 0.2, 1}).apply({2, 3});
    EXPECT_NEAR(p.x, 11 / 1.8, 1e-12);
    EXPECT_NEAR(p.y, 29 / 1.8, 1e-12);
}

TEST(HomographyByHand, AProductIsOneMapAfterTheOther) {
    const Homography shift = mapOf({1, 0, 4, 0, 1, 8, 0, 0, 1}, 3, 4);
    const Homography tilt = mapOf({1, 0, 0, 0, 1, 0, 0.5, 0.25, 1}, 4, 6);
    const Homography both = tilt * shift;
    const cv::Point2d p = both.apply({1, 1});
    EXPECT_NEAR(p.x, 5 / 5.75, 1e-12);
    EXPECT_NEAR(p.y, 9 / 5.75, 1e-12);
    EXPECT_DOUBLE_EQ(both.matrix(2, 2), 1) << "it is 5 before";
    EXPECT_EQ(both.from_frame, 3);
    EXPECT_EQ(both.to_frame, 6);
    EXPECT_DOUBLE_EQ(both.inverse().matrix(2, 2), 1);
    EXPECT_EQ(both.inverse().to_frame, 3);
}

TEST(HomographyByHand, WhatCannotBeUndoneIsRefused) {
    EXPECT_THROW(mapOf({1, 0, 0, 2, 0, 0, 0, 0, 1}).inverse(), Error) << "onto a line";
    EXPECT_THROW(mapOf({1, 0, 0, 0, 0, 1, 0, 1, 0}).inverse(), Error) << "the origin comes from infinity";
}

TEST(HomographyByHand, EnlargementAndTurnAreThoseOfTheSurroundings) {
    // A quarter turn clockwise on screen, twice as large.
    const Homography map = mapOf({0, -2, 7, 2, 0, 5, 0, 0, 1});
    EXPECT_DOUBLE_EQ(map.scaleAt({3, 4}), 2);
    EXPECT_NEAR(map.turned({3, 4}, 0.3), 0.3 + kPi / 2, 1e-12);
    EXPECT_EQ(map.applyToVector({3, 4}, {1, 0}), cv::Point2d(0, 2));
    EXPECT_EQ(map.applyToVector({3, 4}, {0, 1}), cv::Point2d(-2, 0));
}

TEST(BoxByHand, TheBorderBelongsToIt) {
    const OrientedBox box{{10, 20}, 8, 4, 0};
    for (const cv::Point2d on : {cv::Point2d(14, 20), {6, 20}, {10, 22}, {10, 18}, {14, 22}})
        EXPECT_TRUE(box.contains(on)) << on;
    for (const cv::Point2d off : {cv::Point2d(14.1, 20), {5.9, 20}, {10, 22.1}, {10, 17.9}}) {
        EXPECT_FALSE(box.contains(off)) << off;
        EXPECT_TRUE(box.contains(off, 0.25)) << off;
    }
    EXPECT_FALSE(box.contains({14, 20}, -0.25));
    EXPECT_FALSE(box.contains({10, 22}, -0.25));
}

TEST(BoxByHand, CornersBeginAtTheRearLeft) {
    // Heading down on screen: left of it is to the right on screen.
    const auto corners = OrientedBox{{10, 20}, 8, 4, kPi / 2}.corners();
    const std::array<cv::Point2d, 4> expected{{{12, 16}, {12, 24}, {8, 24}, {8, 16}}};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(cv::norm(corners.at(i) - expected.at(i)), 0, 1e-12) << i;
}

TEST(BoxByHand, TheUprightBoxAroundHasTheSumsOfTheSides) {
    for (const double heading : {kPi / 6, -kPi / 6, kPi - kPi / 6, kPi + kPi / 6}) {
        const OrientedBox upright = OrientedBox{{10, 20}, 8, 4, heading}.upright();
        EXPECT_NEAR(upright.length, 8 * std::sqrt(0.75) + 4 * 0.5, 1e-12) << heading;
        EXPECT_NEAR(upright.width, 8 * 0.5 + 4 * std::sqrt(0.75), 1e-12) << heading;
        EXPECT_EQ(upright.heading, 0);
        EXPECT_EQ(upright.centre, cv::Point2d(10, 20));
    }
    const OrientedBox scaled = OrientedBox{{10, 20}, 8, 4, 0.3}.scaled(1.5, 0.25);
    EXPECT_EQ(scaled.length, 12);
    EXPECT_EQ(scaled.width, 1);
    EXPECT_EQ(scaled.heading, 0.3);
}

TEST(BoxByHand, LongBoxesEndToEndStillMeet) {
    const OrientedBox along{{0, 0}, 10, 1, 0};
    EXPECT_NEAR(intersectionArea(along, {{9.5, 0}, 10, 1, 0}), 0.5, 1e-12);
    EXPECT_NEAR(intersectionArea({{0, 0}, 1, 10, 0}, {{0, 9.5}, 1, 10, 0}), 0.5, 1e-12);
    EXPECT_NEAR(intersectionArea(along, {{0, 0}, 1, 10, 0}), 1, 1e-12) << "a cross";
    EXPECT_EQ(intersectionArea(along, {{10.5, 0}, 10, 1, 0}), 0);
    EXPECT_EQ(intersectionArea(along, {{0, 2}, 10, 1, 0}), 0);
}

TEST(BoxByHand, EmptyBoxesShareNothing) {
    const OrientedBox none{{0, 0}, 0, 0, 0};
    EXPECT_EQ(overlap(none, none), 0);
    EXPECT_EQ(containment(none, none), 0);
    EXPECT_EQ(containment(none, {{0, 0}, 4, 2, 0}), 0);
}

TEST(BoxByHand, ContainmentIsTheShareOfTheSmaller) {
    const OrientedBox large{{0, 0}, 20, 10, 0};
    const OrientedBox small{{10, 0}, 4, 2, 0};
    EXPECT_NEAR(containment(large, small), 0.5, 1e-12);
    EXPECT_NEAR(containment(small, large), 0.5, 1e-12);
    EXPECT_NEAR(containment(large, {{3, 3}, 4, 2, 0}), 1, 1e-12);
}

TEST(BoxByHand, MeansAPlaceByAMiddleOrAFifthOfOverlap) {
    const OrientedBox large{{0, 0}, 20, 20, 0};
    const OrientedBox small{{8, 8}, 2, 2, 0};
    EXPECT_TRUE(atPlace(large, small));
    EXPECT_TRUE(atPlace(small, large)) << "whichever holds the other's middle";
    const OrientedBox box{{0, 0}, 10, 2, 0};
    EXPECT_TRUE(atPlace(box, {{0, 1.2}, 10, 2, 0})) << "8 px² of 32";
    EXPECT_FALSE(atPlace(box, {{0, 1.4}, 10, 2, 0})) << "6 px² of 34";
}

TEST(BoxByHand, AUnionIsNoLargerThanNeeded) {
    const OrientedBox both = unionBox({{0, 0}, 4, 2, 0}, {{5, 3}, 2, 2, kPi / 2});
    EXPECT_NEAR(both.centre.x, 2, 1e-12);
    EXPECT_NEAR(both.centre.y, 1.5, 1e-12);
    EXPECT_NEAR(both.length, 8, 1e-12);
    EXPECT_NEAR(both.width, 5, 1e-12);
}

TEST(BoxByHand, AnImageEndsHalfAPixelBeyondTheLastOne) {
    const cv::Size image(100, 60);
    EXPECT_NEAR(areaInImage({{99.5, 30}, 10, 4, 0}, image), 20, 1e-9);
    EXPECT_NEAR(areaInImage({{50, 59.5}, 10, 4, 0}, image), 20, 1e-9);
    EXPECT_NEAR(areaInImage({{50, -0.5}, 10, 4, 0}, image), 20, 1e-9);
    EXPECT_NEAR(areaInImage({{-0.5, 59.5}, 10, 4, 0}, image), 10, 1e-9);
}

TEST(LocalPlaneByHand, PlacesBeyondTheDateLineAreGivenFromTheOtherSide) {
    const LocalPlane plane({0, 179.5});
    EXPECT_NEAR(plane.placeOf({111319.5, 0}).longitude_deg, -179.5, 1e-6);
    EXPECT_NEAR(plane.placeOf({-111319.5, 0}).longitude_deg, 178.5, 1e-6);
    EXPECT_NEAR(plane.placeOf({0, -110574.3}).latitude_deg, -1, 1e-4);
}

TEST(SoundMapByHand, EveryCornerIsEnlargedByLessThanTheLimitEitherWay) {
    const cv::Size image(101, 51);
    const auto enlarged = [&](double factor) { return cv::Matx33d(factor, 0, 9, 0, factor, 9, 0, 0, 1); };
    EXPECT_TRUE(isSoundMap(enlarged(1), image, 1.5));
    EXPECT_TRUE(isSoundMap(enlarged(1.9), image, 2));
    EXPECT_FALSE(isSoundMap(enlarged(2), image, 2)) << "less than twice";
    EXPECT_TRUE(isSoundMap(enlarged(0.55), image, 2));
    EXPECT_FALSE(isSoundMap(enlarged(0.5), image, 2));
    EXPECT_FALSE(isSoundMap(enlarged(3), image, 2));
    EXPECT_FALSE(isSoundMap(enlarged(0.3), image, 2));
}

TEST(SoundMapByHand, NoCornerLiesBehindTheCamera) {
    const cv::Size image(101, 51);
    // Depth 1 at one border and −1 at the other: the enlargement is 1 at all corners.
    EXPECT_FALSE(isSoundMap({1, 0, 0, 0, 1, 0, -0.02, 0, 1}, image, 2));
    EXPECT_FALSE(isSoundMap({1, 0, 0, 0, 1, 0, 0, -0.04, 1}, image, 2));
}

TEST(SoundMapByHand, OneCornerIsEnough) {
    const cv::Size image(101, 51);
    // A depth of .9 enlarges 1.171 times, one of 1.1 0.867 times, one of .8 1.3975 times: by the depth to the power
    // −1.5.
    const auto tilted = [](double right, double down, double depth = 1) {
        const double even = 1 / std::sqrt(depth);
        return cv::Matx33d(even, 0, 0, 0, even, 0, right, down, depth);
    };
    for (const cv::Matx33d& map : {tilted(0.001, 0.002, 0.9), tilted(-0.001, 0.002), tilted(0.001, -0.002)}) {
        EXPECT_FALSE(isSoundMap(map, image, 1.16)) << map;
        EXPECT_TRUE(isSoundMap(map, image, 1.18)) << map;
    }
    EXPECT_FALSE(isSoundMap(tilted(-0.001, -0.002), image, 1.397)) << "the last pixel of the last row";
    EXPECT_TRUE(isSoundMap(tilted(-0.001, -0.002), image, 1.398)) << "and none beyond";
}

}  // namespace
}  // namespace eyrie::geometry_by_hand_test
