#include "removal/part_joining.h"

#include <gtest/gtest.h>

#include "removal/vectors_in_boxes.h"

namespace eyrie {
namespace {

using namespace test;

int kept(const std::vector<Detection>& detections) {
    int count = 0;
    for (const Detection& d : detections) count += d.rejection == Rejection::none;
    return count;
}

TEST(PartJoining, FrontAndRearOfACar) {
    const auto found = joinParts({detection(100, 100, 5, 7), detection(113, 100.5, 4, 6)}, {}, {}, kScale);
    EXPECT_EQ(found[0].rejection, Rejection::none);
    EXPECT_EQ(found[1].rejection, Rejection::duplicate);
    EXPECT_NEAR(found[0].box.length, 17.5, 1e-9);  // 97.5 … 115
    EXPECT_NEAR(found[0].box.width, 7, 1e-9);
}

TEST(PartJoining, FrontAndRearOfABusButNotTwoCars) {
    // 40 px = 10 m: two short parts are a bus, two cars of 4.5 m with a gap of 1 m are two cars.
    EXPECT_EQ(kept(joinParts({detection(100, 100, 8, 9), detection(132, 100, 8, 9)}, {}, {}, kScale)), 1);
    EXPECT_EQ(kept(joinParts({detection(100, 100, 18, 7), detection(122, 100, 18, 7)}, {}, {}, kScale)), 2);
    EXPECT_EQ(kept(joinParts({detection(100, 100, 8, 9), detection(160, 100, 8, 9)}, {}, {}, kScale)), 2) << "17 m";
}

TEST(PartJoining, NotBesideEachOtherNorAtDifferentSpeed) {
    EXPECT_EQ(kept(joinParts({detection(100, 100, 8, 4), detection(100, 107, 8, 4)}, {}, {}, kScale)), 2);
    EXPECT_EQ(kept(joinParts({detection(100, 100, 5, 7, {1, 0}), detection(112, 100, 5, 7, {1.1, 0})}, {}, {}, kScale)),
              2);
    EXPECT_EQ(
        kept(joinParts({detection(100, 100, 5, 7, {1, 0}), detection(112, 100, 5, 7, {1, 0.03})}, {}, {}, kScale)), 1);
    Detection turned = detection(112, 100, 5, 7);
    turned.box.heading = 0.6;
    EXPECT_EQ(kept(joinParts({detection(100, 100, 5, 7), turned}, {}, {}, kScale)), 2);
}

/// Vectors on the outline of a silhouette between two places on the line y = 100.
FrameMotion silhouette(double from, double to) {
    FrameMotion motion;
    for (double x = from; x <= to; x += 2) {
        motion.motion_vectors.push_back(
            {static_cast<CornerId>(motion.motion_vectors.size()), cv::Point2d(x, 97), {1, 0}, 0});
    }
    return motion;
}

TEST(PartJoining, WhatOneSilhouetteHolds) {
    // Two boxes as long as cars, 6 m from middle to middle: cab and load of a lorry, or two cars.
    std::vector<Detection> found{detection(100, 100, 16, 8), detection(124, 100, 16, 8)};
    for (Detection& box : found) box.complete = true;
    EXPECT_EQ(kept(joinParts(found, silhouette(90, 134), {}, kScale)), 1);
    FrameMotion two = silhouette(92, 108);
    for (const MotionVector& vector : silhouette(116, 132).motion_vectors) two.motion_vectors.push_back(vector);
    EXPECT_EQ(kept(joinParts(found, two, {}, kScale)), 2) << "one sees the road between";
    FrameMotion corners = silhouette(90, 134);
    for (MotionVector& vector : corners.motion_vectors) vector.age = 9;
    EXPECT_EQ(kept(joinParts(found, corners, {}, kScale)), 2) << "corners alone are no proof";
    FrameMotion faster = silhouette(90, 134);
    for (MotionVector& vector : faster.motion_vectors) vector.velocity = {2, 0};
    EXPECT_EQ(kept(joinParts(found, faster, {}, kScale)), 2) << "something else that passes";
    found[1].box.centre.x = 190;
    EXPECT_EQ(kept(joinParts(found, silhouette(90, 200), {}, kScale)), 2) << "longer than any vehicle";
}

TEST(PartJoining, CanBeSwitchedOff) {
    PartJoiningOptions options;
    options.enabled = false;
    EXPECT_EQ(kept(joinParts({detection(100, 100, 5, 7), detection(113, 100, 4, 6)}, {}, options, kScale)), 2);
    EXPECT_TRUE(joinParts({}, {}, {}, kScale).empty());
}

}  // namespace
}  // namespace eyrie
