#include "motion/clusters/motion_clustering.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "core/geometry/angle.h"

namespace eyrie::motion_clustering_test {
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

TEST(MotionClustering, LimitsOfMembersAndNoiseAreParameters) {
    FrameMotion motion = emptyMotion();
    motion.corner_count = 22000;
    MotionClusteringOptions options;
    options.max_min_members = 30;
    EXPECT_EQ(MotionClustering(options, {0.1, 25, true}).minMembersFor(motion), 19) << "a third of 58";
    options.max_min_members = 15;
    EXPECT_EQ(MotionClustering(options, {0.1, 25, true}).minMembersFor(motion), 15);
    options.velocity_noise_limit = 0.2;
    EXPECT_DOUBLE_EQ(MotionClustering(options, kScale).linkageFor(1.0).velocity_floor, 0.2);
    EXPECT_DOUBLE_EQ(MotionClustering(options, kScale).linkageFor(0.15).velocity_floor, 0.15);
    options.velocity_noise_factor = 2;
    EXPECT_DOUBLE_EQ(MotionClustering(options, kScale).linkageFor(0.05).velocity_floor, 0.1);
}

TEST(MotionClustering, OnlyWhatFallsIntoVehiclesIsSplit) {
    std::mt19937 random(7);
    FrameMotion motion = emptyMotion();
    // A lorry of 4.8 m, wider than clustering.split_width; 4 px link across the motion, 3 px once that is tightened.
    addObject(motion, {{200, 100}, 20, 16, 0}, 1.5, 300, 0.002, random);
    addObject(motion, {{200, 111.4}, 0, 0, 0}, 1.5, 1, 0, random);
    auto clusters = MotionClustering({}, kScale).cluster(motion);
    ASSERT_EQ(clusters.size(), 1U);
    EXPECT_EQ(clusters[0].members.size(), 301U) << "one vehicle does not lose a vector by that";
    // A row of single vectors and two small groups, which would hold a quarter of it.
    motion = emptyMotion();
    for (int i = 0; i < 18; ++i) addObject(motion, {{200, 100 + 3.5 * i}, 0, 0, 0}, 1.5, 1, 0, random);
    for (const double y : {100.0, 103.5}) addObject(motion, {{201, y}, 0, 0, 0}, 1.5, 2, 0, random);
    clusters = MotionClustering({}, kScale).cluster(motion);
    ASSERT_EQ(clusters.size(), 1U);
    EXPECT_EQ(clusters[0].members.size(), 22U);
}

TEST(MotionClustering, TellsTheGapThatHeldAClusterTogetherLast) {
    FrameMotion motion = emptyMotion();
    const MotionClustering clustering({}, kScale);
    const auto gapAlong = [&](const std::vector<cv::Point2f>& places) {
        motion.motion_vectors.clear();
        std::vector<int> all;
        for (const cv::Point2f& place : places) {
            all.push_back(static_cast<int>(all.size()));
            motion.motion_vectors.push_back({all.back() + 1, place, {2, 0}, 9});
        }
        return clustering.gapInside(motion, all);
    };
    // Neighbours 3, 7 and 5 px apart, where 11.7 are allowed along the motion and 4 across it.
    const LinkageGap along = gapAlong({{100, 100}, {110, 100}, {103, 100}, {115, 100}});
    EXPECT_NEAR(along.ahead, 7, 1e-6);
    EXPECT_NEAR(along.distance, 7 * 0.3 / 3.5, 1e-6);
    EXPECT_EQ(along.parameter, "clustering.along");
    EXPECT_EQ(along.difference, 0);
    const LinkageGap aside = gapAlong({{100, 100}, {102, 103}, {106, 103}});
    EXPECT_NEAR(aside.aside, 3, 1e-6);
    EXPECT_NEAR(aside.ahead, 2, 1e-6);
    EXPECT_EQ(aside.parameter, "clustering.across");
    EXPECT_EQ(gapAlong({{100, 100}, {118, 100}}).parameter, "clustering.roof_length");
    EXPECT_EQ(gapAlong({{100, 100}}).other, -1);
    // What moves otherwise is no link.
    motion.motion_vectors = {{1, {100, 100}, {2, 0}, 9}, {2, {104, 100}, {2, 0}, 9}, {3, {106, 100}, {-2, 0}, 9}};
    EXPECT_NEAR(clustering.gapInside(motion, {0, 1, 2}).ahead, 4, 1e-6);
    motion.motion_vectors[2] = {3, {106, 100}, {2.6F, 0}, 9};
    const LinkageGap outside = clustering.gapOutside(motion, {0, 1});
    EXPECT_EQ(outside.other, 2);
    EXPECT_NEAR(outside.difference, 0.6, 1e-6);
    EXPECT_NEAR(outside.allowed, 0.12 * 2.3, 1e-6) << "a share of the mean speed";
    EXPECT_EQ(outside.parameter, "clustering.velocity_share");
    for (MotionVector& vector : motion.motion_vectors) vector.velocity *= 0.05F;
    EXPECT_EQ(clustering.gapOutside(motion, {0, 1}).allowed, 0.03);
    EXPECT_EQ(clustering.gapOutside(motion, {0, 1}).parameter, "clustering.velocity_floor");
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

TEST(MotionClustering, TracesWhatBecameOfEveryVector) {
    std::mt19937 random(6);
    FrameMotion motion = emptyMotion();
    addObject(motion, {{100, 300}, 15, 6, 0}, 1.5, 40, 0.005, random);
    addObject(motion, {{500, 100}, 2, 2, 0}, 1.5, 2, 0.005, random);
    addObject(motion, {{320, 420}, 300, 6, 0}, 1.0, 900, 0.001, random);  // 90 m
    // Two lanes and a vector beside them, which fall apart when their linkage is tightened.
    addObject(motion, {{200, 100}, 15, 6, 0}, 1.5, 40, 0.005, random);
    addObject(motion, {{203, 111}, 15, 6, 0}, 1.5, 40, 0.005, random);
    addObject(motion, {{203, 122.5}, 0, 0, 0}, 1.5, 1, 0, random);
    MotionClusteringOptions options;
    options.across_m = 3;
    const MotionClustering clustering(options, kScale);
    ClusteringTrace trace;
    const auto clusters = clustering.cluster(motion, &trace);
    ASSERT_EQ(clusters.size(), 3U);
    std::vector<int> told(motion.motion_vectors.size(), 0);
    std::map<ClusterRefusal, int> refused;
    for (const TracedGroup& group : trace.groups) {
        for (const int member : group.members) ++told[static_cast<std::size_t>(member)];
        ++refused[group.refusal];
        ASSERT_EQ(group.cluster >= 0, group.refusal == ClusterRefusal::none);
        if (group.cluster < 0) continue;
        EXPECT_EQ(clusters[static_cast<std::size_t>(group.cluster)].members, group.members);
        EXPECT_EQ(group.split_by, group.cluster == 0 ? "" : "clustering.split_width");
    }
    EXPECT_THAT(told, testing::Each(1));
    EXPECT_EQ(refused[ClusterRefusal::too_few], 1);
    EXPECT_EQ(refused[ClusterRefusal::too_long], 1);
    EXPECT_EQ(refused[ClusterRefusal::split_off], 1);
    EXPECT_EQ(trace.needed, clustering.minMembersFor(motion));
    EXPECT_EQ(trace.needed_parameter, "clustering.min_members");

    const auto verdict = [&](const std::vector<int>& here) { return clustering.verdictOn(here, motion, trace); };
    EXPECT_EQ(verdict({3, 40}).refusal, ClusterRefusal::none) << "one of them is in a cluster";
    EXPECT_EQ(verdict({40, 41}).refusal, ClusterRefusal::too_few);
    const ClusteringVerdict off = verdict({static_cast<int>(told.size()) - 1});
    EXPECT_EQ(off.refusal, ClusterRefusal::split_off);
    EXPECT_EQ(off.parameter, "clustering.split_width");
    EXPECT_GT(off.value, off.limit);
    EXPECT_EQ(verdict({}).refusal, ClusterRefusal::none);
}

TEST(MotionClustering, TellsWhichLimitKeepsVectorsApart) {
    FrameMotion motion = emptyMotion();
    // 6 px aside, where 1.0 m or at least 4 px are allowed.
    motion.motion_vectors = {{1, {98, 98}, {2, 0}, 9}, {2, {102, 98}, {2, 0}, 9}, {3, {100, 104}, {2, 0}, 9}};
    const auto verdictBy = [&](const MotionClusteringOptions& options) {
        const MotionClustering clustering(options, kScale);
        ClusteringTrace trace;
        EXPECT_TRUE(clustering.cluster(motion, &trace).empty());
        return clustering.verdictOn({0, 1, 2}, motion, trace);
    };
    const ClusteringVerdict apart = verdictBy({});
    EXPECT_EQ(apart.refusal, ClusterRefusal::not_linked);
    EXPECT_EQ(apart.here, 3);
    EXPECT_EQ(apart.group, (std::vector<int>{0, 1}));
    EXPECT_EQ(apart.gap.other, 2);
    EXPECT_FALSE(apart.gap.joined);
    EXPECT_NEAR(apart.gap.aside, 6, 1e-6);
    EXPECT_EQ(apart.parameter, "clustering.min_distance");
    MotionClusteringOptions no_floor;
    no_floor.min_distance = 1;
    EXPECT_EQ(verdictBy(no_floor).parameter, "clustering.across");
    motion.motion_vectors[2] = {3, {100, 100}, {1, 0}, 9};
    EXPECT_EQ(verdictBy({}).parameter, "clustering.velocity_share");
}

TEST(MotionClustering, FarAwayVectorsAreLinkedOverMorePixels) {
    FrameMotion motion = emptyMotion();
    // 5.5 px aside, where 1.0 m or at least 4 px are allowed, and 6 px in the far part of a view.
    motion.motion_vectors = {{1, {98, 98}, {2, 0}, 9}, {2, {102, 98}, {2, 0}, 9}, {3, {100, 103.5F}, {2, 0}, 9}};
    const auto clusters = [&](double down_per_px, const MotionClusteringOptions& options) {
        SceneScale scale = kScale;
        scale.slope = ScaleSlope::ofPicture(motion.image_size, 0, down_per_px);
        return MotionClustering(options, scale).cluster(motion).size();
    };
    ASSERT_LT(103.5, motion.image_size.height / 2.0);
    EXPECT_EQ(clusters(0, {}), 0U);
    EXPECT_EQ(clusters(1e-5, {}), 1U) << "it lies above the middle, which is far away";
    EXPECT_EQ(clusters(-1e-5, {}), 0U) << "it lies near by";
    MotionClusteringOptions as_near;
    as_near.min_distance_far = 5;
    EXPECT_EQ(clusters(1e-5, as_near), 0U);
    // Told by name what keeps them apart there.
    SceneScale scale = kScale;
    scale.slope = ScaleSlope::ofPicture(motion.image_size, 0, 1e-5);
    const MotionClustering far_away(as_near, scale);
    ClusteringTrace trace;
    EXPECT_TRUE(far_away.cluster(motion, &trace).empty());
    EXPECT_EQ(far_away.verdictOn({0, 1, 2}, motion, trace).parameter, "clustering.min_distance_far");
}

}  // namespace
}  // namespace eyrie::motion_clustering_test
