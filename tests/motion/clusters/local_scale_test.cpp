#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "motion/clusters/motion_clustering.h"
#include "motion/vectors/shadow_owners.h"

/// Where the slope is so steep that the left of the picture has the least scale and the right the largest, each side
/// must be treated exactly as under that scale everywhere.
namespace eyrie::local_scale_test {
namespace {

constexpr double kGsd = 0.4;

SceneScale steep() {
    SceneScale scale{kGsd, 25, true};
    scale.slope = ScaleSlope::ofPicture({2001, 1001}, 1, 0);
    return scale;
}

SceneScale leftScale() {
    return {kGsd / ScaleSlope::kLeast, 25, true};
}

SceneScale rightScale() {
    return {kGsd / ScaleSlope::kMost, 25, true};
}

FrameMotion emptyMotion() {
    FrameMotion motion;
    motion.image_size = {2001, 1001};
    motion.corner_count = 100000;
    motion.background_speed_sigma = 0.02;
    return motion;
}

/// Vectors at random places of one side of the picture, all moving alike.
FrameMotion vectorsBetween(double left, double right, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> x(static_cast<float>(left), static_cast<float>(right));
    std::uniform_real_distribution<float> y(480, 520);
    FrameMotion motion = emptyMotion();
    for (int i = 0; i < count; ++i) motion.motion_vectors.push_back({i + 1, {x(random), y(random)}, {2, 0.1F}, 9});
    return motion;
}

std::vector<std::vector<int>> membersOf(const std::vector<MotionCluster>& clusters) {
    std::vector<std::vector<int>> members;
    for (const MotionCluster& cluster : clusters) members.push_back(cluster.members);
    return members;
}

TEST(LocalScale, ClustersOfEitherSideAreThoseOfItsScale) {
    MotionClusteringOptions options;
    options.min_distance_far = 0;  // or the left side, which is farther away, had a floor of its own
    const MotionClustering local(options, steep());
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const FrameMotion on_left = vectorsBetween(50, 450, 1200, seed);
        EXPECT_EQ(membersOf(local.cluster(on_left)), membersOf(MotionClustering({}, leftScale()).cluster(on_left)));
        const FrameMotion on_right = vectorsBetween(1500, 1800, 90, seed);
        const auto found = membersOf(local.cluster(on_right));
        EXPECT_EQ(found, membersOf(MotionClustering({}, rightScale()).cluster(on_right)));
        EXPECT_NE(found, membersOf(MotionClustering({}, leftScale()).cluster(on_right))) << "or nothing was tested";
    }
}

TEST(LocalScale, TheReachOfALinkageIsThatOfTheMiddleBetweenTwoVectors) {
    Linkage linkage;
    linkage.along = linkage.across = 10;
    linkage.smallest = 4;
    linkage.slope = ScaleSlope::ofPicture({201, 101}, 0, 0.01);
    const auto joins = [&](float y, float apart) {
        return linkage.joins({1, {100, y - apart / 2}, {1, 0}, 9}, {2, {100, y + apart / 2}, {1, 0}, 9});
    };
    EXPECT_TRUE(joins(50, 9.9F));
    EXPECT_FALSE(joins(50, 10.1F));
    EXPECT_TRUE(joins(100, 14.9F));
    EXPECT_FALSE(joins(100, 15.1F));
    EXPECT_TRUE(joins(-900, 3.9F)) << "no smaller than the smallest";
    EXPECT_FALSE(joins(-900, 4.1F));
    linkage.smallest_far = 6;
    EXPECT_TRUE(joins(-900, 5.9F)) << "no smaller than what is the smallest far away";
    EXPECT_FALSE(joins(-900, 6.1F));
    EXPECT_DOUBLE_EQ(linkage.smallestAt({100, 49}), 6);
    EXPECT_DOUBLE_EQ(linkage.smallestAt({100, 50}), 4) << "as at the centre of the slope";
    EXPECT_DOUBLE_EQ(linkage.smallestAt({100, 100}), 4);
    linkage.smallest_far = 2;
    EXPECT_DOUBLE_EQ(linkage.smallestAt({100, 0}), 4) << "the larger of both counts";
    Linkage flat = linkage;
    flat.smallest_far = 6;
    flat.slope = {};
    EXPECT_DOUBLE_EQ(flat.smallestAt({100, 0}), 4) << "where the view is flat nothing is far away";
    const std::vector<MotionVector> vectors{{1, {100, 100}, {1, 0}, 9}, {2, {100, 0}, {1, 0}, 9}};
    EXPECT_DOUBLE_EQ(linkage.reachAmong(vectors), 15);
    EXPECT_DOUBLE_EQ(linkage.at({100, 0}).along, 5);
    EXPECT_TRUE(linkage.at({100, 0}).slope.isFlat());
}

TEST(LocalScale, ShadowsReachAsFarAsMetresDoThere) {
    // A vehicle of vectors 12 m × 3 m, and beside it what looks like its shadow, as far away as shadows reach there.
    const auto castAt = [](double x, const SceneScale& here, const SceneScale& everywhere) {
        ShadowTestOptions options;
        std::vector<MotionVector> vectors;
        std::vector<char> dark;
        const auto add = [&](double ahead_m, double aside_m, char is_dark) {
            vectors.push_back({static_cast<CornerId>(vectors.size() + 1),
                               {static_cast<float>(x + here.px(ahead_m)), static_cast<float>(500 + here.px(aside_m))},
                               {2, 0},
                               9});
            dark.push_back(is_dark);
        };
        for (int i = 0; i < 8; ++i) {
            add(0.6 * i, 0, 0);
            add(0.6 * i, 0.9, 0);
            add(0.6 * i, 1.8, 0);
        }
        for (int i = 0; i < 6; ++i) add(0.6 * i, 1.8 + 0.9 * options.shadow_reach_m, 1);
        return ShadowOwners(options, everywhere).castShadows(vectors, dark, 0.02);
    };
    EXPECT_EQ(castAt(300, leftScale(), steep()), castAt(300, leftScale(), leftScale()));
    const auto right = castAt(1500, rightScale(), steep());
    EXPECT_EQ(right, castAt(1500, rightScale(), rightScale()));
    EXPECT_EQ(std::count(right.begin(), right.end(), 1), 6);
    const auto too_short = castAt(1500, rightScale(), leftScale());
    EXPECT_EQ(std::count(too_short.begin(), too_short.end(), 1), 0) << "or nothing was tested";
}

}  // namespace
}  // namespace eyrie::local_scale_test
