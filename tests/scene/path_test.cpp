#include "scene/traffic/path.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace eyrie::path_test
