#include "core/geometry/oriented_box.h"

#include <gtest/gtest.h>

#include <random>

#include "core/geometry/angle.h"

namespace eyrie::oriented_box_test {
namespace {

/// Slow and obvious: counts the points of a fine raster in both boxes.
double overlapByRaster(const OrientedBox& a, const OrientedBox& b) {
    int both = 0;
    int either = 0;
    for (double y = -40; y < 40; y += 0.1) {
        for (double x = -40; x < 40; x += 0.1) {
            const bool in_a = a.contains({x, y});
            const bool in_b = b.contains({x, y});
            both += in_a && in_b;
            either += in_a || in_b;
        }
    }
    return either ? double(both) / either : 0;
}

}  // namespace

TEST(OrientedBox, headingNinetyPointsDownOnScreen) {
    const OrientedBox box{{10, 20}, 8, 4, kPi / 2};
    const cv::Point2d front = box.toImage({4, 0});
    EXPECT_NEAR(front.x, 10, 1e-12);
    EXPECT_NEAR(front.y, 24, 1e-12);
    const cv::Point2d right = box.toImage({0, 2});
    EXPECT_NEAR(right.x, 8, 1e-12);
}

TEST(OrientedBox, overlapOfHandWorkedBoxes) {
    const OrientedBox a{{0, 0}, 4, 2, 0};
    EXPECT_DOUBLE_EQ(overlap(a, a), 1);
    EXPECT_NEAR(overlap(a, {{2, 0}, 4, 2, 0}), 4.0 / 12.0, 1e-12);
    EXPECT_NEAR(overlap(a, {{0, 0}, 4, 2, kPi / 2}), 4.0 / 12.0, 1e-12);
    EXPECT_DOUBLE_EQ(overlap(a, {{5, 0}, 4, 2, 0}), 0);
    EXPECT_DOUBLE_EQ(overlap(a, {{0, 0}, 0, 2, 0}), 0);
}

TEST(OrientedBox, nearlyIdenticalBoxesOverlapAlmostFully) {
    const OrientedBox a{{100, 50}, 97, 56, 0};
    EXPECT_GT(overlap(a, {{100.3, 50.2}, 97.9, 56.4, 0}), 0.97);
    EXPECT_GT(overlap(a, {{100, 50}, 97, 56, 1e-9}), 0.999);
}

TEST(OrientedBox, overlapAgreesWithARasterAndIsSymmetric) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-6, 6), size(2, 20), angle(-4, 4);
    for (int i = 0; i < 12; ++i) {
        const OrientedBox a{{place(random), place(random)}, size(random), size(random), angle(random)};
        const OrientedBox b{{place(random), place(random)}, size(random), size(random), angle(random)};
        EXPECT_NEAR(overlap(a, b), overlapByRaster(a, b), 0.02);
        EXPECT_NEAR(overlap(a, b), overlap(b, a), 1e-9);
    }
}

TEST(OrientedBox, unionHoldsBothAndKeepsTheHeading) {
    const OrientedBox a{{0, 0}, 4, 2, 0.3};
    const OrientedBox b{{5, 3}, 3, 2, 1.2};
    const OrientedBox both = unionBox(a, b);
    EXPECT_DOUBLE_EQ(both.heading, 0.3);
    for (const auto& corner : a.corners()) EXPECT_TRUE(both.contains(corner, 1e-9));
    for (const auto& corner : b.corners()) EXPECT_TRUE(both.contains(corner, 1e-9));
}

TEST(OrientedBox, areaInImageCountsTheVisiblePart) {
    EXPECT_NEAR(areaInImage({{-0.5, 50}, 10, 4, 0}, {100, 100}), 20, 1e-9);
    EXPECT_NEAR(areaInImage({{50, 50}, 10, 4, 0.4}, {100, 100}), 40, 1e-9);
    EXPECT_DOUBLE_EQ(areaInImage({{200, 50}, 10, 4, 0}, {100, 100}), 0);
}

}  // namespace eyrie::oriented_box_test
