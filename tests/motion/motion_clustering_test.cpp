#include "motion/clusters/motion_clustering.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/geometry/angle.h"

namespace eyrie {
namespace {

const SceneScale kScale{0.3, 25, true};

/// Vectors of a box-shaped object that moves along its heading and may turn (radians per frame).
void addObject(FrameMotion& motion, const OrientedBox& box, double speed, int count, double noise, std::mt19937& random,
               double turn_rate = 0) {
    std::uniform_real_distribution<double> unit(-0.5, 0.5);
    std::normal_distribution<double> error(0, noise);
    for (int i = 0; i < count; ++i) {
        const cv::Point2d in_box(unit(random) * box.length, unit(random) * box.width);
        const cv::Point2d position = box.toImage(in_box);
        const cv::Point2d arm = position - box.centre;
        const cv::Point2d velocity = box.direction() * speed + turn_rate * cv::Point2d(-arm.y, arm.x) +
                                     cv::Point2d(error(random), error(random));
        motion.motion_vectors.push_back(
            {static_cast<CornerId>(motion.motion_vectors.size() + 1), position, velocity, 9});
    }
}

FrameMotion emptyMotion() {
    FrameMotion motion;
    motion.image_size = {640, 480};
    motion.corner_count = 7000;  // 0.023 per px²: 2 vectors on a car of 90 px²
    motion.background_speed_sigma = 0.02;
    return motion;
}

TEST(MotionClustering, BoxesAVehicleInItsDirection) {
    std::mt19937 random(1);
    FrameMotion motion = emptyMotion();
    const OrientedBox vehicle{{200, 100}, 15, 6, 0.6};
    addObject(motion, vehicle, 1.5, 60, 0.01, random);
    const auto clusters = MotionClustering({}, kScale).cluster(motion);
    ASSERT_EQ(clusters.size(), 1U);
    EXPECT_EQ(clusters[0].members.size(), 60U);
    EXPECT_TRUE(std::is_sorted(clusters[0].members.begin(), clusters[0].members.end()));
    EXPECT_NEAR(clusters[0].box.heading, 0.6, 0.02);
    EXPECT_GT(overlap(clusters[0].box, vehicle), 0.8);
    EXPECT_NEAR(cv::norm(clusters[0].velocity), 1.5, 0.01);
}

TEST(MotionClustering, KeepsLanesApart) {
    std::mt19937 random(2);
    FrameMotion motion = emptyMotion();
    // Two cars side by side, 3.3 m from centre to centre: 11 px, a gap of 5 px ≈ 1.5 m, the same speed.
    addObject(motion, {{200, 100}, 15, 6, 0}, 1.5, 40, 0.01, random);
    addObject(motion, {{203, 111}, 15, 6, 0}, 1.5, 40, 0.01, random);
    EXPECT_EQ(MotionClustering({}, kScale).cluster(motion).size(), 2U);
    EXPECT_EQ(MotionClustering(MotionClusteringOptions::thesis(), kScale).cluster(motion).size(), 1U)
        << "one distance in all directions merges them";
}

TEST(MotionClustering, SeparatesOvertakingVehiclesBySpeed) {
    std::mt19937 random(3);
    FrameMotion motion = emptyMotion();
    addObject(motion, {{200, 100}, 15, 6, 0}, 1.5, 40, 0.005, random);
    addObject(motion, {{204, 107}, 15, 6, 0}, 1.8, 40, 0.005, random);
    EXPECT_EQ(MotionClustering({}, kScale).cluster(motion).size(), 2U);
}

TEST(MotionClustering, KeepsATurningVehicleWhole) {
    std::mt19937 random(4);
    FrameMotion motion = emptyMotion();
    // 20° a second at 25 Hz: front and rear differ by 15 px · 0.014 = 0.2 px/frame, neighbours by little.
    addObject(motion, {{200, 100}, 15, 6, 0.3}, 1.0, 60, 0.01, random, 0.014);
    const auto clusters = MotionClustering({}, kScale).cluster(motion);
    ASSERT_EQ(clusters.size(), 1U);
    EXPECT_GT(clusters[0].members.size(), 55U);
    EXPECT_NEAR(turnBetween(clusters[0].box.heading, 0.3), 0, 0.05);
}

TEST(MotionClustering, DemandsMembersByDensity) {
    MotionClustering clustering({}, kScale);
    FrameMotion motion = emptyMotion();
    motion.corner_count = 1000;
    EXPECT_EQ(clustering.minMembersFor(motion), 3);
    motion.corner_count = 22000;  // 0.0716 · 90 px² = 6.4 expected, a third of it is 2
    EXPECT_EQ(clustering.minMembersFor(motion), 3);
    EXPECT_EQ(MotionClustering({}, {0.1, 25, true}).minMembersFor(motion), 12) << "58 expected, 19 wanted, 12 at most";
    EXPECT_EQ(MotionClustering({}, {0.15, 25, true}).minMembersFor(motion), 9) << "25.8 expected";
    motion.image_size = {0, 0};
    EXPECT_EQ(clustering.minMembersFor(motion), 3);
}

TEST(MotionClustering, NoiseRaisesTheVelocityFloorUpToALimit) {
    const MotionClustering clustering({}, kScale);
    EXPECT_DOUBLE_EQ(clustering.linkageFor(0.0).velocity_floor, 0.03);
    EXPECT_DOUBLE_EQ(clustering.linkageFor(0.05).velocity_floor, 0.05);
    EXPECT_DOUBLE_EQ(clustering.linkageFor(1.0).velocity_floor, 0.06);
    EXPECT_DOUBLE_EQ(MotionClustering({}, {2.0, 25, true}).linkageFor(0).across, 4) << "pixel floor";
}

TEST(MotionClustering, DropsWhatIsTooLargeForTraffic) {
    std::mt19937 random(5);
    FrameMotion motion = emptyMotion();
    addObject(motion, {{320, 240}, 600, 400, 0}, 1.0, 20000, 0.001, random);  // 180 m × 120 m moving as one
    EXPECT_TRUE(MotionClustering({}, kScale).cluster(motion).empty());
}

TEST(MotionClustering, TakesDegenerateInput) {
    const MotionClustering clustering({}, kScale);
    EXPECT_TRUE(clustering.cluster({}).empty());
    FrameMotion motion = emptyMotion();
    for (int i = 0; i < 5; ++i) motion.motion_vectors.push_back({i, {10, 10}, {0, 0}, 9});
    const auto still = clustering.cluster(motion);
    ASSERT_EQ(still.size(), 1U);
    EXPECT_TRUE(std::isfinite(still[0].box.heading));
    for (MotionVector& v : motion.motion_vectors) v.velocity.x = std::nanf("");
    EXPECT_TRUE(clustering.cluster(motion).empty());
}

}  // namespace
}  // namespace eyrie
