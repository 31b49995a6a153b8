#include "scene/traffic/path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/geometry/angle.h"

namespace eyrie::path_test {

TEST(Path, rightIsClockwiseOnTheMap) {
    const Path path({{0, 0}, {10, 0}});
    EXPECT_NEAR(path.beside(4, 2).x, 4, 1e-12);
    EXPECT_NEAR(path.beside(4, 2).y, 2, 1e-12);
    EXPECT_NEAR(path.position(12).x, 12, 1e-12) << "goes on straight beyond its end";
    EXPECT_NEAR(path.position(-3).x, -3, 1e-12);
}

TEST(Path, roundsCornersWithArcs) {
    // A right turn with radius 10: two legs of 40 and a quarter of a circle.
    const Path path = Path::rounded({{0, 0}, {50, 0}, {50, 50}}, 10);
    EXPECT_NEAR(path.length(), 80 + 5 * kPi, 0.02);
    EXPECT_NEAR(path.curvature(40 + 2.5 * kPi), 0.1, 0.002) << "positive: to the right";
    EXPECT_NEAR(path.curvature(20), 0, 1e-9);
    const cv::Point2d middle = path.position(40 + 2.5 * kPi);
    EXPECT_NEAR(std::hypot(middle.x - 40, middle.y - 10), 10, 0.01);
    const cv::Point2d direction = path.direction(path.length());
    EXPECT_NEAR(direction.x, 0, 1e-9);
    EXPECT_NEAR(direction.y, 1, 1e-9);
    const Path left = Path::rounded({{0, 0}, {50, 0}, {50, -50}}, 10);
    EXPECT_NEAR(left.curvature(40 + 2.5 * kPi), -0.1, 0.002);
}

TEST(Path, whatIsCalledStraightHasNoBend) {
    // Bends from 40 m to 40 + 5 π m, over vertices half a metre apart; a bend is measured 1.5 m around a place.
    const Path path = Path::rounded({{0, 0}, {50, 0}, {50, 50}}, 10);
    EXPECT_TRUE(path.isStraight(2, 37));
    EXPECT_TRUE(path.isStraight(60, 75));
    EXPECT_FALSE(path.isStraight(2, 45));
    EXPECT_FALSE(path.isStraight(39, 39.5));
    EXPECT_FALSE(path.isStraight(45, 47));
    EXPECT_FALSE(path.isStraight(54, 80));
    for (double s = 0; s < path.length(); s += 0.1) {
        if (!path.isStraight(s, s)) continue;
        EXPECT_NEAR(path.curvature(s), 0, 1e-8) << s;
    }
}

TEST(Path, directionTurnsWithoutJumps) {
    const Path path = Path::rounded({{0, 0}, {50, 0}, {50, 50}}, 10);
    for (double s = 0; s < path.length(); s += 0.1) {
        const cv::Point2d a = path.direction(s);
        const cv::Point2d b = path.direction(s + 0.1);
        EXPECT_LT(std::abs(a.x * b.y - a.y * b.x), 0.02) << s;
    }
}

TEST(Path, findsItsNearestPoint) {
    const Path path = Path::rounded({{0, 0}, {100, 0}, {160, 60}, {300, 60}}, 40);
    for (double s = 3; s < path.length() - 3; s += 7.3) {
        EXPECT_NEAR(path.nearest(path.beside(s, 2.5)), s, 0.6) << s;
    }
    EXPECT_NEAR(path.nearest(path.position(120), 100, 140), 120, 0.5);
}

TEST(Path, shiftedReversedAndParts) {
    const Path path = Path::rounded({{0, 0}, {100, 0}}, 10);
    EXPECT_NEAR(path.shifted(3).position(10).y, 3, 1e-9);
    EXPECT_NEAR(path.reversed().shifted(3).position(10).y, -3, 1e-9);
    EXPECT_NEAR(path.part(20, 45).length(), 25, 1e-9);
    EXPECT_NEAR(path.part(20, 45).position(5).x, 25, 1e-9);
}

TEST(Path, partsWithoutLengthAreLeftOutAndOneIsNeeded) {
    const Path path({{0, 0}, {0, 0}, {3, 4}, {3, 4}, {3, 10}});
    EXPECT_EQ(path.points().size(), 3U);
    EXPECT_DOUBLE_EQ(path.length(), 11);
    EXPECT_NEAR(path.position(2.5).x, 1.5, 1e-12);
    EXPECT_NEAR(path.position(2.5).y, 2, 1e-12);
    EXPECT_NEAR(path.position(8).y, 7, 1e-12);
    EXPECT_THROW(Path({{1, 1}, {1, 1}}), Error);
    // At a corner it looks from the point before to the one behind: along (3, 10).
    EXPECT_NEAR(path.direction(5).x, 3 / std::hypot(3, 10), 1e-12);
    EXPECT_NEAR(path.direction(0).x, 0.6, 1e-12);
    EXPECT_NEAR(path.direction(11).y, 1, 1e-12);
}

TEST(Path, straightPiecesHaveAVertexEveryHalfMetre) {
    const Path path = Path::rounded({{0, 0}, {3.2, 0}}, 10);
    EXPECT_EQ(path.points().size(), 8U) << "seven pieces of at most half a metre";
    EXPECT_NEAR(path.points()[1].x, 3.2 / 7, 1e-12);
    EXPECT_EQ(Path::rounded({{0, 0}, {3, 0}}, 10).points().size(), 7U);
}

TEST(Path, cornersWithoutRoomGetASmallerArc) {
    // Of the shorter leg, 4 m, at most 49 % goes into the corner: the arc of a quarter turn has as long a radius.
    const Path path = Path::rounded({{0, 0}, {4, 0}, {4, 30}}, 10);
    EXPECT_NEAR(path.length(), (4 - 1.96) + (30 - 1.96) + 1.96 * kPi / 2, 0.02);
    const cv::Point2d middle = path.position(4 - 1.96 + 1.96 * kPi / 4);
    EXPECT_NEAR(std::hypot(middle.x - (4 - 1.96), middle.y - 1.96), 1.96, 0.03);
}

TEST(Path, thePartBetweenTwoLengthsKeepsItsCorner) {
    const Path path({{0, 0}, {10, 0}, {10, 10}});
    const Path part = path.part(4, 13);
    EXPECT_EQ(part.points(), (std::vector<cv::Point2d>{{4, 0}, {10, 0}, {10, 3}}));
    EXPECT_EQ(path.part(0, 10).points(), (std::vector<cv::Point2d>{{0, 0}, {10, 0}})) << "each vertex once";
}

TEST(Path, theNearestVertexLiesBetweenTheLimits) {
    std::vector<cv::Point2d> points;
    for (int i = 0; i <= 40; ++i) points.emplace_back(i, 0);
    const Path path(points);
    EXPECT_DOUBLE_EQ(path.nearest({17.2, 5}), 17);
    EXPECT_DOUBLE_EQ(path.nearest({17.2, 5}, 20, 30), 20);
    EXPECT_DOUBLE_EQ(path.nearest({17.2, 5}, 3, 12), 12);
    EXPECT_DOUBLE_EQ(path.nearest({-9, 5}), 0);
    EXPECT_DOUBLE_EQ(path.nearest({99, 5}), 40);
    EXPECT_DOUBLE_EQ(path.nearest({17.2, 5}, 20.2, 20.8), 20.2) << "no vertex between";
}

TEST(Path, stripsAndRectanglesGoRoundClockwise) {
    const Path path({{0, 0}, {10, 0}});
    EXPECT_EQ(stripAlong(path, 2, 4, 1, 3), (std::vector<cv::Point2d>{{2, 1}, {3, 1}, {4, 1}, {4, 3}, {3, 3}, {2, 3}}));
    EXPECT_EQ(stripAlong(path, 2, 2.4, 1, 3).size(), 4U);
    EXPECT_EQ(rectangleAt({10, 20}, {0, 1}, 8, 4), (std::vector<cv::Point2d>{{12, 16}, {12, 24}, {8, 24}, {8, 16}}));
}

}  // namespace eyrie::path_test
