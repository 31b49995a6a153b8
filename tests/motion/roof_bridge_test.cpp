#include "motion/differences/roof_bridge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "motion/clusters/motion_clustering.h"

namespace eyrie::roof_bridge_test {
namespace {

const SceneScale kScale{0.25, 25, true};  // 6 m are 24 px, the ordinary 3.5 m are 14 px

/// Front and rear of a lorry that drives to the right: two columns of vectors 20 px apart. Corners stand beside its
/// lane.
FrameMotion lorry(float rear_speed = 2) {
    FrameMotion motion;
    motion.image_size = {640, 480};
    motion.corner_count = 3000;
    motion.background_speed_sigma = 0.02;
    for (int k = 0; k < 4; ++k) {
        const float y = 100 + 2 * static_cast<float>(k);
        motion.motion_vectors.push_back({static_cast<CornerId>(2 * k + 1), {200, y}, {2, 0}, 9});
        motion.motion_vectors.push_back({static_cast<CornerId>(2 * k + 2), {180, y}, {rear_speed, 0}, 9});
    }
    for (int x = 140; x <= 240; x += 5) {
        for (int y = 60; y <= 150; y += 5) {
            if (std::abs(y - 103) > 9) motion.stationary_corners.emplace_back(float(x), float(y));
        }
    }
    return motion;
}

std::size_t clustersOf(const FrameMotion& motion, const MotionClusteringOptions& options = {}) {
    return MotionClustering(options, kScale).cluster(motion).size();
}

TEST(RoofBridge, JoinsFrontAndRearOfAPlainRoof) {
    EXPECT_EQ(clustersOf(lorry()), 1U);
}

TEST(RoofBridge, TheRoadBetweenTwoCarsKeepsThemApart) {
    FrameMotion motion = lorry();
    for (int k = 0; k < 4; ++k) motion.stationary_corners.emplace_back(190.F, 100 + 2 * static_cast<float>(k));
    EXPECT_EQ(clustersOf(motion), 2U);
    // Corners at the ends and beyond say nothing.
    motion = lorry();
    for (const float x : {170.F, 181.F, 199.F, 210.F}) motion.stationary_corners.emplace_back(x, 103.F);
    EXPECT_EQ(clustersOf(motion), 1U);
}

TEST(RoofBridge, WhereTheGroundHasNoCornersTheirAbsenceSaysNothing) {
    FrameMotion night = lorry();
    night.stationary_corners.clear();
    EXPECT_EQ(clustersOf(night), 2U);
}

TEST(RoofBridge, OnlyWhatMovesAlikeIsOneVehicle) {
    // 0.24 px/frame may differ between neighbours, half of it across a roof.
    EXPECT_EQ(clustersOf(lorry(2.1F)), 1U);
    EXPECT_EQ(clustersOf(lorry(2.16F)), 2U);
}

TEST(RoofBridge, CanBeSwitchedOff) {
    MotionClusteringOptions options;
    options.roof_length_m = 0;
    EXPECT_EQ(clustersOf(lorry(), options), 2U);
    EXPECT_EQ(clustersOf(lorry(), MotionClusteringOptions::thesis()), 2U);
}

TEST(RoofBridge, EqualsAskingEveryPair) {
    const Linkage linkage{10, 4, 0.05, 0.1};
    const RoofBridge bridge{25, 2};
    Linkage far = linkage;
    far.along = bridge.length;
    far.velocity_floor /= 2;
    far.velocity_share /= 2;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> x(0, 250);
        std::normal_distribution<float> speed(0, 0.05F);
        FrameMotion motion;
        for (int i = 0; i < 150; ++i)
            motion.motion_vectors.push_back(
                {static_cast<CornerId>(i + 1), {x(random), x(random)}, {1.5F + speed(random), speed(random)}, 9});
        motion.motion_vectors[7].position.x = std::nanf("");
        for (int i = 0; i < 250; ++i) motion.stationary_corners.emplace_back(x(random), x(random));

        const std::vector<int> linked = singleLinkage(motion.motion_vectors, linkage);
        std::vector<int> label = linked;
        const auto relabel = [&](int from, int to) {
            for (int& l : label) l = l == from ? to : l;
        };
        for (std::size_t i = 0; i < label.size(); ++i) {
            for (std::size_t j = i + 1; j < label.size(); ++j) {
                const MotionVector& a = motion.motion_vectors[i];
                const MotionVector& b = motion.motion_vectors[j];
                if (label[i] == label[j] || !far.joins(a, b)) continue;
                const cv::Point2d way = b.position - a.position;
                const double length = cv::norm(way);
                const cv::Point2d middle = (cv::Point2d(a.position) + cv::Point2d(b.position)) / 2;
                bool free = true;
                int around = 0;
                for (const cv::Point2f& s : motion.stationary_corners) {
                    const cv::Point2d offset = s - a.position;
                    const double ahead = offset.dot(way) / length;
                    const double aside = std::abs(offset.cross(way)) / length;
                    if (ahead > 1.5 && ahead < length - 1.5 && aside < bridge.half_width) free = false;
                    around += cv::norm(cv::Point2d(s) - middle) <= bridge.length;
                }
                const double expected =
                    around / (CV_PI * bridge.length * bridge.length) * (length - 3) * 2 * bridge.half_width;
                if (free && length > 3 && expected >= 0.4) relabel(label[j], label[i]);
            }
        }
        const std::vector<int> joined = joinAcrossRoofs(motion, linkage, bridge, linked);
        for (std::size_t i = 0; i < label.size(); ++i) {
            for (std::size_t j = 0; j < label.size(); ++j)
                ASSERT_EQ(joined[i] == joined[j], label[i] == label[j]) << "seed " << seed << ", " << i << ", " << j;
        }
    }
}

}  // namespace
}  // namespace eyrie::roof_bridge_test
