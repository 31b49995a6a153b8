#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "core/review/zone.h"

/// Where places lie beside zones and lines, worked out by hand; y points down, right is clockwise.
namespace eyrie::zone_by_hand_test {
namespace {

using Points = std::vector<cv::Point2d>;

constexpr const char* kNoLength = "the line has no length: draw its points apart";
constexpr const char* kNoArea = "the zone has no area: its corners must not be on one line";
constexpr const char* kCrosses = "the outline crosses itself: give its corners in their order around the area";

std::string fault(ZoneShape shape, Points points) {
    Zone zone;
    zone.shape = shape;
    zone.points = std::move(points);
    return faultOf(zone);
}

TEST(ZoneByHand, ALineIsAPixelLongAtLeastAlongAllOfIt) {
    EXPECT_EQ(fault(ZoneShape::line, {{0, 0}, {0, 1}}), "");
    EXPECT_EQ(fault(ZoneShape::line, {{0, 0}, {0.99, 0}}), kNoLength);
    EXPECT_EQ(fault(ZoneShape::line, {{0, 0}, {0, 0.4}, {0.4, 0.4}, {0.4, 0}}), "") << "there and back";
    EXPECT_EQ(fault(ZoneShape::line, {{0, 0}, {0, 0.4}, {0.4, 0.4}}), kNoLength);
}

TEST(ZoneByHand, AnAreaHasASquarePixelAtLeast) {
    EXPECT_EQ(fault(ZoneShape::area, {{0, 0}, {2, 0}, {2, 1}}), "");
    EXPECT_EQ(fault(ZoneShape::area, {{0, 0}, {2, 0}, {2, 0.9}}), kNoArea);
    EXPECT_EQ(fault(ZoneShape::area, {{0, 0}, {0, 1}, {1, 1}, {1, 0}}), "") << "either way round";
    EXPECT_EQ(fault(ZoneShape::area, {{0, 0}, {0, 0.9}, {1, 0.9}, {1, 0}}), kNoArea);
}

TEST(ZoneByHand, EveryPointHasAPlace) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(fault(ZoneShape::line, {{0, 0}, {none, 9}}), "a point has no place");
    EXPECT_EQ(fault(ZoneShape::area, {{0, none}, {9, 0}, {9, 9}}), "a point has no place");
}

TEST(ZoneByHand, AnOutlineMayTurnBackAndTouchItselfButNotCross) {
    EXPECT_EQ(fault(ZoneShape::area, {{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 30}, {0, 30}}), "") << "an L";
    // The third of these corners lies on the first edge.
    const Points touching{{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}};
    for (const bool mirrored : {false, true})
        for (const bool back : {false, true}) {
            Points points = touching;
            if (mirrored)
                for (cv::Point2d& at : points) at.y = 40 - at.y;
            if (back) std::reverse(points.begin(), points.end());
            for (int turn = 0; turn < 5; ++turn) {
                EXPECT_EQ(fault(ZoneShape::area, points), "") << mirrored << back << turn;
                std::rotate(points.begin(), points.begin() + 1, points.end());
            }
        }
    // An edge to the last corner and the one from it cross the first.
    Points crossing{{0, 0}, {10, 0}, {10, 10}, {5, -5}, {0, 10}};
    for (int turn = 0; turn < 5; ++turn) {
        EXPECT_EQ(fault(ZoneShape::area, crossing), kCrosses) << turn;
        std::rotate(crossing.begin(), crossing.begin() + 1, crossing.end());
    }
}

TEST(ZoneByHand, DistanceIsThatToTheNearestPointOfAnEdge) {
    const Points line{{0, 0}, {10, 0}};
    EXPECT_DOUBLE_EQ(distanceTo(line, false, {3, 4}), 4);
    EXPECT_DOUBLE_EQ(distanceTo(line, false, {-3, 4}), 5) << "before its beginning";
    EXPECT_DOUBLE_EQ(distanceTo(line, false, {13, -4}), 5) << "behind its end";
    EXPECT_DOUBLE_EQ(distanceTo({{2, 1}, {8, 9}}, false, {1, 8}), 5) << "from a slanted one, of 3 : 4";
    EXPECT_DOUBLE_EQ(distanceTo({{5, 5}, {5, 5}}, false, {8, 9}), 5) << "from one without length";
    const Points open{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    EXPECT_DOUBLE_EQ(distanceTo(open, false, {5, -2}), 2) << "the first edge";
    EXPECT_DOUBLE_EQ(distanceTo(open, false, {12, 5}), 2);
    EXPECT_DOUBLE_EQ(distanceTo(open, false, {5, 12}), 2) << "the last one";
    EXPECT_DOUBLE_EQ(distanceTo(open, false, {-2, 5}), std::sqrt(29));
    EXPECT_DOUBLE_EQ(distanceTo(open, true, {-2, 5}), 2) << "the edge that closes it";
}

TEST(ZoneByHand, InsideIsInsideAlsoBesideCorners) {
    const Points diamond{{0, -10}, {10, 0}, {0, 10}, {-10, 0}};
    for (const cv::Point2d in : {cv::Point2d(0, 0), {-9, 0}, {9, 0}, {4, 5}, {-4, -5}})
        EXPECT_TRUE(isInside(diamond, in)) << in;
    for (const cv::Point2d out :
         {cv::Point2d(-11, 0), {11, 0}, {6, 5}, {-6, -5}, {-5, 10}, {5, -10}, {0, 11}, {0, -11}})
        EXPECT_FALSE(isInside(diamond, out)) << out;
    const Points triangle{{0, 0}, {20, 0}, {0, 10}};
    EXPECT_TRUE(isInside(triangle, {11, 4}));
    EXPECT_FALSE(isInside(triangle, {13, 4})) << "the slanted edge is at 12";
    const Points hollow{{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 30}, {0, 30}};
    EXPECT_TRUE(isInside(hollow, {5, 20}));
    EXPECT_FALSE(isInside(hollow, {15, 20})) << "in the angle of an L";
}

TEST(ZoneByHand, ALineIsCrossedToTheRightOrToTheLeft) {
    const Points line{{0, 0}, {10, 0}};
    EXPECT_EQ(crossing(line, {5, -5}, {5, 5}), 1);
    EXPECT_EQ(crossing(line, {5, 5}, {5, -5}), -1);
    EXPECT_EQ(crossing(line, {12, -5}, {12, 5}), 0) << "behind its end";
    EXPECT_EQ(crossing(line, {-2, -5}, {-2, 5}), 0) << "before its beginning";
    EXPECT_EQ(crossing(line, {5, -5}, {5, -1}), 0) << "not far enough";
    EXPECT_EQ(crossing({{0, 0}, {0, 10}}, {5, 5}, {-5, 5}), 1) << "right of a line downwards is left on screen";
    EXPECT_EQ(crossing({{2, 1}, {8, 9}}, {7, 4}, {3, 6}), 1) << "a slanted one";
    EXPECT_EQ(crossing({}, {0, 0}, {9, 9}), 0);
}

TEST(ZoneByHand, AStepThatEndsOnTheLineIsNotCountedTwice) {
    const Points line{{0, 0}, {10, 0}};
    EXPECT_EQ(crossing(line, {5, -5}, {5, 0}), 1);
    EXPECT_EQ(crossing(line, {5, 0}, {5, 5}), 0);
    EXPECT_EQ(crossing(line, {5, 5}, {5, 0}), 0);
    EXPECT_EQ(crossing(line, {5, 0}, {5, -5}), -1);
}

TEST(ZoneByHand, AStepOverACornerIsOneCrossingOrNone) {
    EXPECT_EQ(crossing({{0, 0}, {10, 0}, {20, 0}}, {10, -5}, {10, 5}), 1);
    EXPECT_EQ(crossing({{0, -1}, {10, 0}, {0, 1}}, {10, -5}, {10, 5}), 0) << "it only touches the tip";
}

TEST(ZoneByHand, CrossingsThereAndBackMakeNone) {
    EXPECT_EQ(crossing({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {5, -5}, {5, 15}), 0);
    const Points spiral{{0, 0}, {10, 0}, {12, 20}, {-12, 20}, {-12, 10}, {10, 10}};
    EXPECT_EQ(crossing(spiral, {5, -5}, {5, 15}), 1) << "twice the same way is that way";
    EXPECT_EQ(crossing(spiral, {5, 15}, {5, -5}), -1);
}

}  // namespace
}  // namespace eyrie::zone_by_hand_test
