#include "motion/clusters/place_contents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eyrie::place_contents_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// 20 × 10 px, from x = 90 to 110 and y = 95 to 105.
constexpr double kLength = 20, kWidth = 10;
const OrientedBox kPlace{{100, 100}, kLength, kWidth, 0};

FrameMotion motionAt(const std::vector<cv::Point2f>& places) {
    FrameMotion motion;
    for (const cv::Point2f place : places)
        motion.motion_vectors.push_back({CornerId(motion.motion_vectors.size()) + 1, place, {2, 0}, 9});
    return motion;
}

MotionCluster clusterOf(std::vector<int> members, OrientedBox box = {}) {
    MotionCluster cluster;
    cluster.members = std::move(members);
    cluster.box = box;
    return cluster;
}

}  // namespace

TEST(PlaceContents, VectorsUpToAPixelOutsideBelongToAPlace) {
    const FrameMotion motion = motionAt({{100, 100}, {111, 106}, {111.1F, 100}, {100, 106.1F}, {89, 94}, {88.9F, 100}});
    EXPECT_THAT(vectorsAtPlace(kPlace, motion), ElementsAre(0, 1, 4));
    EXPECT_THAT(vectorsAtPlace(kPlace, FrameMotion{}), IsEmpty());
}

TEST(PlaceContents, ClustersWithMostVectorsThereComeFirst) {
    const FrameMotion motion = motionAt({{95, 100}, {97, 100}, {99, 100}, {101, 100}, {103, 100}, {300, 300}});
    const std::vector<MotionCluster> clusters = {clusterOf({0}), clusterOf({5}), clusterOf({1, 2, 5}), clusterOf({3}),
                                                 clusterOf({4, 5})};
    EXPECT_THAT(clustersAtPlace(kPlace, motion, clusters), ElementsAre(2, 0, 3, 4)) << "equals as they stand";
}

TEST(PlaceContents, OfClustersWithoutVectorsTheBoxDecides) {
    const FrameMotion motion = motionAt({{100, 100}, {300, 300}});
    const OrientedBox far{{300, 300}, kLength, kWidth, 0};
    EXPECT_THAT(
        clustersAtPlace(kPlace, motion,
                        {clusterOf({}, kPlace), clusterOf({}, far), clusterOf({0}, far), clusterOf({1}, kPlace)}),
        ElementsAre(2, 0))
        << "one with vectors elsewhere is elsewhere, whatever its box";
}

}  // namespace eyrie::place_contents_test
