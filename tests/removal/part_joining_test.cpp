#include "removal/part_joining.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angle.h"
#include "removal/vectors_in_boxes.h"

namespace eyrie::part_joining_test {
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

TEST(PartJoining, LimitsInMetresAreThoseOfThePlace) {
    // 40 px are 10 m in the middle, a bus; where a metre has half as many pixels they are no one vehicle's.
    SceneScale oblique = kScale;
    oblique.slope = ScaleSlope::ofPicture({640, 480}, 0, 0.003);
    const auto partsAt = [](double y) {
        return std::vector<Detection>{detection(400, y, 8, 9), detection(432, y, 8, 9)};
    };
    ASSERT_LT(oblique.slope.factorAt({416, 60}), 0.5);
    ASSERT_GT(oblique.slope.factorAt({416, 300}), 1);
    EXPECT_EQ(kept(joinParts(partsAt(300), {}, {}, oblique)), 1);
    EXPECT_EQ(kept(joinParts(partsAt(60), {}, {}, oblique)), 2);
    EXPECT_EQ(kept(joinParts(partsAt(60), {}, {}, kScale)), 1);
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

TEST(PartJoining, LimitsDecideOnEitherSideOfThePartsTheyAreAbout) {
    const auto joined = [](const char* name, const char* value, const Detection& a, const Detection& b) {
        PartJoiningOptions options;
        setParameter(describeOf(options), name, value);
        return kept(joinParts({a, b}, {}, options, kScale)) == 1;
    };
    // Two parts of 2 m that together are 10 m long.
    const Detection front = detection(132, 100, 8, 9), rear = detection(100, 100, 8, 9);
    EXPECT_TRUE(joined("duplicates.part_length", "2.5", front, rear));
    EXPECT_TRUE(joined("duplicates.part_length", "2.1", front, rear));
    EXPECT_FALSE(joined("duplicates.part_length", "1.9", front, rear));
    const auto part = [](double x, cv::Point2d velocity) { return detection(x, 100, 5, 7, velocity); };
    // So slow that a share of their speed allows nothing.
    EXPECT_FALSE(joined("duplicates.part_velocity_floor", "0.04", part(100, {0.2, 0}), part(112, {0.2, 0.05})));
    EXPECT_TRUE(joined("duplicates.part_velocity_floor", "0.06", part(100, {0.2, 0}), part(112, {0.2, 0.05})));
    // They differ by 8 % of their speed.
    EXPECT_FALSE(joined("duplicates.part_velocity_share", "0.05", part(100, {2, 0}), part(112, {2, 0.16})));
    EXPECT_FALSE(joined("duplicates.part_velocity_share", "0.075", part(100, {2, 0}), part(112, {2, 0.16})));
    EXPECT_TRUE(joined("duplicates.part_velocity_share", "0.085", part(100, {2, 0}), part(112, {2, 0.16})));
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

/// Whether two boxes of 16 × 8 px, 24 px apart, are joined by these vectors.
bool joinedBy(const FrameMotion& motion, const SceneScale& scale = kScale, double width = 8) {
    PartJoiningOptions options;
    options.part_vehicle_width_m = 20;
    return kept(joinParts({detection(100, 100, 16, 8), detection(124, 100, 16, width)}, motion, options, scale)) == 1;
}

TEST(PartJoining, ASilhouetteIsFollowedNearTheWayFromMiddleToMiddle) {
    const auto shifted = [](double by) {
        FrameMotion motion = silhouette(90, 134);
        for (MotionVector& vector : motion.motion_vectors) vector.position.y = static_cast<float>(100 + by);
        return motion;
    };
    for (const double side : {-1.0, 1.0}) {
        EXPECT_TRUE(joinedBy(shifted(side * 4.9))) << "half the width and 1 px";
        EXPECT_FALSE(joinedBy(shifted(side * 5.1)));
        EXPECT_FALSE(joinedBy(shifted(side * 4.9), kScale, 6)) << "of the narrower one";
    }
    EXPECT_FALSE(joinedBy(silhouette(90, 99))) << "all behind the middle of the one";
    EXPECT_FALSE(joinedBy(silhouette(125, 134))) << "all before the middle of the other";
}

TEST(PartJoining, ASilhouetteHasNoGapBeyondTheLimit) {
    const auto withGap = [](double gap) {
        FrameMotion motion = silhouette(100, 110);
        for (const MotionVector& vector : silhouette(110 + gap, 130).motion_vectors)
            motion.motion_vectors.push_back(vector);
        return motion;
    };
    EXPECT_TRUE(joinedBy(withGap(4))) << "1 m";
    EXPECT_FALSE(joinedBy(withGap(4.2)));
    EXPECT_FALSE(joinedBy(silhouette(105, 134))) << "from the very middle of the first …";
    EXPECT_TRUE(joinedBy(silhouette(103, 134)));
    EXPECT_FALSE(joinedBy(silhouette(90, 119))) << "… to that of the second";
    const SceneScale coarse{0.4, 25, true};  // 1 m is 2.5 px
    EXPECT_TRUE(joinedBy(withGap(3), coarse)) << "3 px are no gap, however coarse the picture";
    EXPECT_FALSE(joinedBy(withGap(3.2), coarse));
    FrameMotion mixed = withGap(4);
    for (std::size_t i = 1; i < mixed.motion_vectors.size(); ++i) mixed.motion_vectors[i].age = 9;
    EXPECT_FALSE(joinedBy({})) << "nothing is no silhouette";
    mixed.motion_vectors[4].age = 0;
    EXPECT_TRUE(joinedBy(mixed)) << "corners lie on the vehicle, too";
}

TEST(PartJoining, ASilhouetteMovesLikeItsVehicle) {
    const auto moving = [](float x, float y) {
        FrameMotion motion = silhouette(90, 134);
        for (MotionVector& vector : motion.motion_vectors) vector.velocity = {x, y};
        return joinedBy(motion);
    };
    EXPECT_TRUE(moving(1.24F, 0)) << "0.24 of 0.248";
    EXPECT_FALSE(moving(1.26F, 0)) << "0.26 of 0.252";
    PartJoiningOptions options;
    FrameMotion slow = silhouette(90, 134);
    const std::vector<Detection> pair{detection(100, 100, 16, 8, {0.1, 0}), detection(124, 100, 16, 8, {0.1, 0})};
    for (MotionVector& vector : slow.motion_vectors) vector.velocity = {0.19F, 0};
    EXPECT_EQ(kept(joinParts(pair, slow, options, kScale)), 1) << "0.09 of a floor of 0.1";
    for (MotionVector& vector : slow.motion_vectors) vector.velocity = {0.21F, 0};
    EXPECT_EQ(kept(joinParts(pair, slow, options, kScale)), 2);
    options.part_silhouette_gap_m = 0;
    EXPECT_EQ(kept(joinParts(pair, silhouette(90, 134), options, kScale)), 2) << "silhouettes are not looked at";
}

TEST(PartJoining, LengthsThatAreAllowedAndTraced) {
    struct Case {
        double one, other, apart;  // px: lengths and distance of the middles
        double limit;              // px; 0: not joined
        const char* parameter;
    };
    for (const Case& c :
         {Case{5, 7, 16, 52, "duplicates.part_vehicle_length"}, Case{10, 10, 42, 52, "duplicates.part_vehicle_length"},
          Case{10, 10, 43, 0, ""}, Case{10.5, 5, 14, 22, "duplicates.part_car_length"},
          Case{5, 10.5, 14.25, 22, "duplicates.part_car_length"}, Case{5, 10.5, 14.5, 0, ""},
          Case{10.5, 5, 14.5, 0, ""}}) {
        RemovalTrace trace;
        const auto found = joinParts({detection(100, 100, c.one, 7), detection(100 + c.apart, 100, c.other, 7)}, {}, {},
                                     kScale, &trace);
        ASSERT_EQ(kept(found), c.limit > 0 ? 1 : 2) << c.one << " " << c.other << " " << c.apart;
        ASSERT_EQ(trace.duplicates.size(), c.limit > 0 ? 1U : 0U);
        if (trace.duplicates.empty()) continue;
        EXPECT_EQ(trace.duplicates[0].kept, 0);
        EXPECT_EQ(trace.duplicates[0].removed, 1);
        EXPECT_NEAR(trace.duplicates[0].value, (c.one + c.other) / 2 + c.apart, 1e-9);
        EXPECT_EQ(trace.duplicates[0].limit, c.limit);
        EXPECT_EQ(trace.duplicates[0].parameter, c.parameter);
        EXPECT_NEAR(found[0].box.length, (c.one + c.other) / 2 + c.apart, 1e-9);
    }
    const auto onOne = [](double apart) {
        const std::vector<Detection> pair{detection(100, 100, 16, 8), detection(100 + apart, 100, 16, 8)};
        return kept(joinParts(pair, silhouette(90, 190), {}, kScale)) == 1;
    };
    EXPECT_TRUE(onOne(56)) << "18 m";
    EXPECT_FALSE(onOne(56.25));
    RemovalTrace trace;
    joinParts({detection(100, 100, 16, 8), detection(124, 100, 16, 8)}, silhouette(90, 134), {}, kScale, &trace);
    ASSERT_EQ(trace.duplicates.size(), 1U);
    EXPECT_EQ(trace.duplicates[0].limit, 72);
    EXPECT_EQ(trace.duplicates[0].parameter, "duplicates.part_silhouette_length");
}

TEST(PartJoining, AVehicleIsNoWiderThanItsParts) {
    const auto joined = [](double width, double other_width, double aside) {
        const std::vector<Detection> pair{detection(100, 100, 6, width), detection(112, 100 + aside, 6, other_width)};
        return kept(joinParts(pair, {}, {}, kScale)) == 1;
    };
    EXPECT_TRUE(joined(6, 6, 4)) << "10 px of 1.5 · 6 + 1";
    EXPECT_FALSE(joined(6, 6, 4.1));
    EXPECT_TRUE(joined(6, 3, 4.5)) << "of the wider one";
    EXPECT_TRUE(joined(3, 6, 4.5));
    EXPECT_TRUE(joined(12, 12, 0.8)) << "3.2 m";
    EXPECT_FALSE(joined(12, 12, 0.9));
    EXPECT_TRUE(joined(16, 6, 0)) << "a wide part does not get wider";
    const SceneScale coarse{1, 25, true};  // 3.2 px, less than a box of few corners may measure
    EXPECT_EQ(kept(joinParts({detection(100, 100, 2, 3), detection(104, 101, 2, 3)}, {}, {}, coarse)), 1);
    EXPECT_EQ(kept(joinParts({detection(100, 100, 2, 3), detection(104, 101.1, 2, 3)}, {}, {}, coarse)), 2);
}

TEST(PartJoining, HeadingsOfPartsAgreeAndTheLargerOneLeads) {
    for (const double turn : {-19.0, 19.0, -21.0, 21.0}) {
        Detection turned = detection(110, 100, 8, 6);
        turned.box.heading = radiansFromDegrees(turn);
        const auto found = joinParts({detection(100, 100, 5, 6), turned}, {}, {}, kScale);
        EXPECT_EQ(kept(found), std::abs(turn) < 20 ? 1 : 2) << turn;
        if (std::abs(turn) > 20) continue;
        EXPECT_NEAR(found[0].box.heading, turned.box.heading, 1e-12);
    }
    PartJoiningOptions straight;
    straight.part_max_turn_deg = 0;
    EXPECT_EQ(kept(joinParts({detection(100, 100, 5, 6), detection(110, 100, 5, 6)}, {}, straight, kScale)), 1);
}

TEST(PartJoining, TheWholeIsWhatItsPartsAre) {
    Detection large = detection(100, 100, 8, 6, {2, 0});
    Detection small = detection(110, 100, 4, 6, {2.06, 0.03});
    large.score = 0.2;
    small.score = 0.7;
    large.complete = true;
    FrameMotion outline = silhouette(90, 120);
    for (MotionVector& vector : outline.motion_vectors) vector.velocity = {2, 0};
    auto whole = joinParts({large, small}, outline, {}, kScale)[0];
    EXPECT_NEAR(whole.velocity.x, 2.02, 1e-12) << "weighted by 48 and 24 px²";
    EXPECT_NEAR(whole.velocity.y, 0.01, 1e-12);
    EXPECT_EQ(whole.score, 0.7);
    EXPECT_FALSE(whole.complete) << "a part was not";
    EXPECT_EQ(kept(joinParts({large, small}, {}, {}, kScale)), 2) << "a whole vehicle has no further part";
    EXPECT_EQ(kept(joinParts({small, large}, {}, {}, kScale)), 2);
    small.complete = true;
    whole = joinParts({large, small}, outline, {}, kScale)[0];
    EXPECT_TRUE(whole.complete);
}

TEST(PartJoining, TheClosestPairGoesFirst) {
    // 22 px hold two of them: the middle one goes with its nearer neighbour.
    const auto found =
        joinParts({detection(100, 100, 12, 7), detection(110, 100, 5, 7), detection(118, 100, 11, 7)}, {}, {}, kScale);
    EXPECT_EQ(found[0].box.length, 12);
    EXPECT_EQ(found[1].rejection, Rejection::none);
    EXPECT_EQ(found[2].rejection, Rejection::duplicate);
    EXPECT_NEAR(found[1].box.length, 16, 1e-9);  // 107.5 … 123.5
}

TEST(PartJoining, CanBeSwitchedOff) {
    PartJoiningOptions options;
    options.join_parts = false;
    EXPECT_EQ(kept(joinParts({detection(100, 100, 5, 7), detection(113, 100, 4, 6)}, {}, options, kScale)), 2);
    EXPECT_TRUE(joinParts({}, {}, {}, kScale).empty());
}

}  // namespace
}  // namespace eyrie::part_joining_test
