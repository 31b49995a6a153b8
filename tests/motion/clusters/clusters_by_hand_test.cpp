/// Clusters of a few vectors at places that are written down, on both sides of every limit.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/geometry/angle.h"
#include "motion/clusters/motion_clustering.h"
#include "motion/vectors/background_noise.h"

namespace eyrie::clusters_by_hand_test {
namespace {

const SceneScale kTenToAMetre{0.1, 25, true};

/// The thesis' rules, so that nothing decides but what a test switches on: 13 px link.
MotionClusteringOptions bare() {
    MotionClusteringOptions options = MotionClusteringOptions::thesis();
    options.along_m = options.across_m = 1.3;
    return options;
}

FrameMotion moving(const std::vector<cv::Point2f>& places, cv::Point2f velocity = {1.5F, 0}) {
    FrameMotion motion;
    motion.image_size = {640, 480};
    for (const cv::Point2f& place : places)
        motion.motion_vectors.push_back({static_cast<CornerId>(motion.motion_vectors.size() + 1), place, velocity, 9});
    return motion;
}

/// Lines of five vectors, 2 px apart along the motion, `apart` px beside each other.
FrameMotion lines(int count, float apart) {
    std::vector<cv::Point2f> places;
    for (int line = 0; line < count; ++line)
        for (int i = 0; i < 5; ++i)
            places.emplace_back(100 + 2.F * static_cast<float>(i), 100 + apart * static_cast<float>(line));
    return moving(places);
}

std::size_t countOf(const MotionClusteringOptions& options, const FrameMotion& motion) {
    return MotionClustering(options, kTenToAMetre).cluster(motion).size();
}

}  // namespace

TEST(ClustersByHand, ABoxLiesAroundItsVectorsInTheirMeanDirection) {
    MotionClusteringOptions options = bare();
    options.margin = 0.5;
    FrameMotion motion = moving({{100, 50}, {106, 50}, {103, 53}});
    motion.motion_vectors[0].velocity = {1.45F, 0.03F};
    motion.motion_vectors[1].velocity = {1.55F, -0.03F};
    const auto clusters = MotionClustering(options, kTenToAMetre).cluster(motion);
    ASSERT_EQ(clusters.size(), 1U);
    EXPECT_NEAR(clusters[0].velocity.x, 1.5, 1e-6);
    EXPECT_NEAR(clusters[0].velocity.y, 0, 1e-6);
    EXPECT_NEAR(clusters[0].box.heading, 0, 1e-6);
    EXPECT_NEAR(clusters[0].box.centre.x, 103, 1e-4);
    EXPECT_NEAR(clusters[0].box.centre.y, 51.5, 1e-4);
    EXPECT_NEAR(clusters[0].box.length, 6 + 1, 1e-4);
    EXPECT_NEAR(clusters[0].box.width, 3 + 1, 1e-4);
    EXPECT_EQ(clusters[0].members, (std::vector<int>{0, 1, 2}));
    const auto down =
        MotionClustering(options, kTenToAMetre).cluster(moving({{100, 50}, {106, 50}, {103, 53}}, {0, 2}));
    ASSERT_EQ(down.size(), 1U);
    EXPECT_NEAR(down[0].box.heading, kPi / 2, 1e-6);
    EXPECT_NEAR(down[0].box.length, 3 + 1, 1e-4);
    EXPECT_NEAR(down[0].box.width, 6 + 1, 1e-4);
}

TEST(ClustersByHand, WhatIsWiderThanAVehicleAndTwoPixelsIsLinkedMoreTightly) {
    MotionClusteringOptions options = bare();
    options.split_width_m = 1;  // 10 px and 2; three quarters of 13 px are 9.75
    EXPECT_EQ(countOf(options, lines(2, 11.9F)), 1U);
    EXPECT_EQ(countOf(options, lines(2, 12.1F)), 2U);
    options.split_width_m = 0;
    EXPECT_EQ(countOf(options, lines(2, 12.1F)), 1U) << "switched off";
}

TEST(ClustersByHand, FourTimesTheLinkageIsTightened) {
    MotionClusteringOptions options = bare();
    options.split_width_m = 1;
    // 13 px · .75⁴ are 4.11 px.
    EXPECT_EQ(countOf(options, lines(4, 4.2F)), 4U);
    EXPECT_EQ(countOf(options, lines(4, 4.05F)), 1U) << "12.15 px wide, but it holds together";
}

TEST(ClustersByHand, WhatIsTooLongIsLinkedMoreTightlyAlongItsMotion) {
    MotionClusteringOptions options = bare();
    options.split_length_m = 5;  // 50 px and 2
    const auto row = [](float apart) {
        std::vector<cv::Point2f> places;
        for (int i = 0; i < 6; ++i) places.emplace_back(100 + apart * static_cast<float>(i), 100.F);
        return moving(places);
    };
    EXPECT_EQ(countOf(options, row(10.3F)), 1U) << "51.5 px";
    EXPECT_EQ(countOf(options, row(10.5F)), 6U) << "52.5 px, of which 9.75 link";
}

TEST(ClustersByHand, WhatIsTooLargeIsRefusedWithItsSizeAndLimit) {
    const FrameMotion motion = moving({{100, 50}, {109, 50}, {104, 54}});  // 10 × 5 px with the margin
    const auto refusedBy = [&](double max_length, double max_width) {
        MotionClusteringOptions options = bare();
        options.margin = 0.5;
        options.max_length_m = max_length;
        options.max_width_m = max_width;
        ClusteringTrace trace;
        const auto clusters = MotionClustering(options, kTenToAMetre).cluster(motion, &trace);
        EXPECT_EQ(clusters.empty(), trace.groups.at(0).refusal != ClusterRefusal::none);
        return trace.groups.at(0);
    };
    EXPECT_EQ(refusedBy(1.01, 0.51).refusal, ClusterRefusal::none);
    const TracedGroup too_long = refusedBy(0.99, 0);
    EXPECT_EQ(too_long.refusal, ClusterRefusal::too_long);
    EXPECT_NEAR(too_long.value, 10, 1e-4);
    EXPECT_NEAR(too_long.limit, 9.9, 1e-9);
    EXPECT_EQ(too_long.parameter, "clustering.max_length");
    const TracedGroup too_wide = refusedBy(0, 0.49);
    EXPECT_EQ(too_wide.refusal, ClusterRefusal::too_wide);
    EXPECT_NEAR(too_wide.value, 5, 1e-4);
    EXPECT_NEAR(too_wide.limit, 4.9, 1e-9);
    EXPECT_EQ(refusedBy(0, 0).refusal, ClusterRefusal::none) << "no limits";
}

TEST(ClustersByHand, SixtyCornersTellTheNoiseOfTheirBaseline) {
    const auto sigmaWith = [](int count) {
        BackgroundNoise noise(10);
        for (int i = 0; i < count; ++i) noise.add(5, 0.1);
        for (int i = 0; i < 1000; ++i) noise.add(10, 0.02);  // 0.2 px
        noise.finish();
        return noise;
    };
    EXPECT_NEAR(sigmaWith(60).sigma(5), 0.1 / 1.17741, 1e-6);
    EXPECT_NEAR(sigmaWith(59).sigma(5), 0.2 / 5 / 1.17741, 1e-6) << "0.2 px of all over five frames";
    EXPECT_NEAR(sigmaWith(0).sigma(1), 0.2 / 1.17741, 1e-6);
    EXPECT_EQ(sigmaWith(60).sigma(11), sigmaWith(60).sigma(10)) << "longer ones as the longest";
}

}  // namespace eyrie::clusters_by_hand_test
