#include <gtest/gtest.h>

#include "motion/clusters/motion_clustering.h"

namespace eyrie::clustering_thresholds_test {
namespace {

MotionClusteringOptions with(const std::string& name, const std::string& value) {
    MotionClusteringOptions options;
    setParameter(describeOf(options), name, value);
    return options;
}

/// `count` vectors 2 px apart along their motion.
void addRow(FrameMotion& motion, cv::Point2f start, float speed, int count) {
    for (int i = 0; i < count; ++i) {
        motion.motion_vectors.push_back({static_cast<CornerId>(motion.motion_vectors.size() + 1),
                                         start + cv::Point2f(2.0F * float(i), 0),
                                         {speed, 0},
                                         9});
    }
}

}  // namespace

TEST(ClusteringThresholds, VelocityNoiseLimitIsHowFarNoiseMayRaiseTheAllowedDifference) {
    FrameMotion motion;
    motion.image_size = {640, 480};
    motion.background_speed_sigma = 1;
    // So slow that a share of their speed allows nothing.
    addRow(motion, {200, 100}, 0.3F, 8);
    addRow(motion, {200, 102}, 0.38F, 8);
    const auto clusters = [&](const char* limit) {
        return MotionClustering(with("clustering.velocity_noise_limit", limit), {0.3, 25, true}).cluster(motion).size();
    };
    EXPECT_EQ(clusters("0.06"), 2U);
    EXPECT_EQ(clusters("0.075"), 2U);
    EXPECT_EQ(clusters("0.085"), 1U);
    motion.background_speed_sigma = 0.07;
    EXPECT_EQ(clusters("0.085"), 2U) << "there is not as much noise as that";
}

TEST(ClusteringThresholds, MaxMinMembersIsEnoughHoweverDenseTheCornersAre) {
    FrameMotion motion;
    motion.image_size = {640, 480};
    motion.corner_count = 22000;  // at 0.1 m/px a third of those on a car are 19
    addRow(motion, {200, 100}, 1, 14);
    const auto clusters = [&](const char* most) {
        return MotionClustering(with("clustering.max_min_members", most), {0.1, 25, true}).cluster(motion).size();
    };
    EXPECT_EQ(clusters("12"), 1U);
    EXPECT_EQ(clusters("14"), 1U);
    EXPECT_EQ(clusters("15"), 0U);
    EXPECT_EQ(clusters("1000"), 0U);
}

}  // namespace eyrie::clustering_thresholds_test
