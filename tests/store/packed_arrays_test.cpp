#include "store/runs/packed_arrays.h"

#include <gmock/gmock.h>

#include <limits>

namespace eyrie::packed_arrays_test {
namespace {

TEST(PackedPoints, AreExactToAThirtySecondOfAPixel) {
    std::vector<cv::Point2f> points;
    for (int i = 0; i < 4000; ++i) {
        points.emplace_back(static_cast<float>(i) * 1.02347F, static_cast<float>(i) * 0.31831F);
    }
    const auto read = unpackPoints(packPoints(points));
    ASSERT_TRUE(read.has_value());
    ASSERT_EQ(read->size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR((*read)[i].x, points[i].x, 1.0 / 32);
        EXPECT_NEAR((*read)[i].y, points[i].y, 1.0 / 32);
    }
}

TEST(PackedPoints, TakeFourBytesEachInOrdinaryFrames) {
    EXPECT_EQ(packPoints(std::vector<cv::Point2f>(100, {767.5F, 0.F})).size(), 401U);
}

TEST(PackedPoints, KeepTheirPrecisionInHugeFramesAndOutsideOfThem) {
    const std::vector<cv::Point2f> points{{7679.3F, 4319.9F}, {-0.4F, -3.1F}, {4095.9F, 4096.F}, {30000.F, 2.F}};
    const auto read = unpackPoints(packPoints(points));
    ASSERT_TRUE(read.has_value());
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR((*read)[i].x, points[i].x, 1.0 / 32);
        EXPECT_NEAR((*read)[i].y, points[i].y, 1.0 / 32);
    }
}

TEST(PackedPoints, SurviveWhatIsNoNumber) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const auto read = unpackPoints(packPoints(std::vector<cv::Point2f>{{nan, 3}, {infinity, -infinity}, {1e30F, 1}}));
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ((*read)[0], cv::Point2f(0, 3));
    EXPECT_EQ((*read)[1], cv::Point2f(0, 0));
    EXPECT_EQ((*read)[2].y, 1);
}

TEST(PackedMotionVectors, AreExact) {
    const std::vector<MotionVector> vectors{
        {-1, {0.1F, 1e-30F}, {-2.5F, 3.75F}, 5},
        {std::numeric_limits<CornerId>::max(), {7679.99F, 4319.F}, {0, -0.F}, 1 << 30}};
    const auto read = unpackMotionVectors(packMotionVectors(vectors));
    ASSERT_TRUE(read.has_value());
    ASSERT_EQ(read->size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ((*read)[i].id, vectors[i].id);
        EXPECT_EQ((*read)[i].position, vectors[i].position);
        EXPECT_EQ((*read)[i].velocity, vectors[i].velocity);
        EXPECT_EQ((*read)[i].age, vectors[i].age);
    }
}

TEST(PackedArrays, OfNothingAreNothing) {
    EXPECT_TRUE(unpackMotionVectors(packMotionVectors({}))->empty());
    EXPECT_TRUE(unpackPoints(packPoints({}))->empty());
    EXPECT_TRUE(unpackIndices(packIndices({}))->empty());
    EXPECT_TRUE(unpackPoints({})->empty());
}

TEST(PackedArrays, RefuseBytesThatNoPackingYields) {
    EXPECT_FALSE(unpackMotionVectors(Bytes(27)).has_value());
    EXPECT_FALSE(unpackIndices(Bytes(5)).has_value());
    EXPECT_FALSE(unpackPoints(Bytes(9, std::byte{3})).has_value()) << "unknown format";
    EXPECT_FALSE(unpackPoints(Bytes(8, std::byte{2})).has_value()) << "half a point";
}

TEST(PackedIndices, AreExact) {
    EXPECT_THAT(*unpackIndices(packIndices(std::vector<int>{0, -1, 22000})), testing::ElementsAre(0, -1, 22000));
}

}  // namespace
}  // namespace eyrie::packed_arrays_test
