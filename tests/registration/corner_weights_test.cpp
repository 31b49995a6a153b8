#include <gtest/gtest.h>

#include "registration/corners/corner_tracker.h"
#include "registration/flight.h"

namespace eyrie::corner_weights_test {
namespace {

/// Corners placed by hand and where they were found again: 10 px to the right.
struct PlacedCorners {
    CornerSet set;
    std::vector<TrackedPosition> found;

    TrackedCorner& add(float x, float y) {
        TrackedCorner corner;
        corner.id = static_cast<CornerId>(set.corners.size() + 1);
        corner.position = {x, y};
        set.corners.push_back(corner);
        TrackedPosition position;
        position.found = true;
        position.position = {x + 10, y};
        found.push_back(position);
        return set.corners.back();
    }
    /// `noise` in grey levels.
    Correspondences pairs(double noise = 1) const {
        return CornerTracker({}, test::scaleOf(0.3)).correspondences(set, found, test::kSize, noise);
    }
};

}  // namespace

TEST(CornerWeights, aCrowdDoesNotOutweighTheRestOfThePicture) {
    // Cells of 20 px: twenty corners in the first, one in each of five others, beside it and below it.
    PlacedCorners corners;
    for (int i = 0; i < 20; ++i) corners.add(float(i) * 0.9F, float(i % 7));
    for (const cv::Point2f at :
         {cv::Point2f(30, 5), cv::Point2f(5, 30), cv::Point2f(300, 230), cv::Point2f(5, 239), cv::Point2f(319, 5)})
        corners.add(at.x, at.y);
    const Correspondences pairs = corners.pairs();
    ASSERT_EQ(pairs.size(), 25);
    for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(pairs.weight[i], 2.0 / 20, 1e-6);
    for (std::size_t i = 20; i < 25; ++i) EXPECT_NEAR(pairs.weight[i], 1, 1e-6) << i;
    EXPECT_EQ(pairs.to_x[20], pairs.from_x[20] + 10);
    EXPECT_EQ(pairs.to_y[20], pairs.from_y[20]);
}

TEST(CornerWeights, noisyCornersWeighLessAndLostOnesNothing) {
    PlacedCorners corners;
    for (int i = 0; i < 4; ++i) corners.add(10 + 40 * float(i), 100);
    corners.found[1].position_variance = 0.0025F / 2 / 9;  // with noise of 3 as much as what a perfect corner scatters
    corners.found[2].position_variance = 3 * 0.0025F / 2 / 9;
    corners.found[3].found = false;
    const Correspondences pairs = corners.pairs(3);
    EXPECT_NEAR(pairs.weight[0], 1, 1e-6);
    EXPECT_NEAR(pairs.weight[1], 0.5, 1e-5);
    EXPECT_NEAR(pairs.weight[2], 0.25, 1e-5);
    EXPECT_EQ(pairs.weight[3], 0);
    EXPECT_EQ(pairs.to_x[3], pairs.from_x[3]);
}

TEST(CornerWeights, whatIsKnownToMoveSaysNothingAboutTheGround) {
    PlacedCorners corners;
    for (int i = 0; i < 12; ++i) {
        TrackedCorner& corner = corners.add(10 + 21 * float(i), 100);
        corner.age = 4;
        corner.drift = {0.01F, 0};
        if (i < 3) corner.drift = {0, -0.12F};
        if (i == 3) corner.drift = {0.07F, 0};
        if (i == 0) corner.age = 3;
    }
    const Correspondences pairs = corners.pairs();
    EXPECT_EQ(pairs.weight[0], 1) << "too young to be known";
    EXPECT_EQ(pairs.weight[1], 0);
    EXPECT_EQ(pairs.weight[2], 0);
    for (std::size_t i = 3; i < 12; ++i) EXPECT_EQ(pairs.weight[i], 1) << i;
}

TEST(CornerWeights, whereTheGroundScattersMovingTakesMore) {
    // Half of Rayleigh distributed drifts lie below 1.1774 σ, here 0.1 px; from 4 σ on a corner moves: 0.34 px.
    PlacedCorners corners;
    for (int i = 0; i < 11; ++i) {
        TrackedCorner& corner = corners.add(10 + 21 * float(i), 100);
        corner.age = 9;
        corner.drift = {0, 0.1F};
    }
    corners.set.corners[4].drift = {0.33F, 0};
    corners.set.corners[5].drift = {0.35F, 0};
    const Correspondences pairs = corners.pairs();
    EXPECT_EQ(pairs.weight[4], 1);
    EXPECT_EQ(pairs.weight[5], 0);
}

TEST(CornerWeights, whenMostSeemToMoveTheGroundWasMistaken) {
    PlacedCorners corners;
    for (int i = 0; i < 12; ++i) {
        TrackedCorner& corner = corners.add(10 + 21 * float(i), 100);
        corner.age = 9;
        corner.drift = {i < 5 ? 0.0F : 0.5F, 0};
    }
    // The middle one of the found drifts is that of a standing corner, so that the others move.
    for (std::size_t i = 5; i < 7; ++i) corners.set.corners[i].drift = {0, 0};
    const Correspondences seven_stand = corners.pairs();
    EXPECT_EQ(std::count(seven_stand.weight.begin(), seven_stand.weight.end(), 0.0F), 5);
    for (std::size_t i = 0; i < 2; ++i) corners.found[i].found = false;
    const Correspondences half = corners.pairs();
    EXPECT_EQ(std::count(half.weight.begin(), half.weight.end(), 0.0F), 2) << "only those that were lost";
}

TEST(CornerWeights, whereSpecksOnTheLensMakeTheGroundSeemToMoveItIsBelieved) {
    // Of a camera that hovers: specks do not move at all, and of the ground no more than half is as calm.
    const auto leftOut = [](int calm, int young) {
        PlacedCorners corners;
        for (int i = 0; i < 24; ++i) {
            TrackedCorner& corner = corners.add(10 + 12 * float(i), 100);
            corner.age = 9;
            corner.sticks = i < 14;
            corner.drift = {i < 14 + calm ? 0.0F : 0.2F, 0};
            if (i >= 24 - young) corner.age = 3;
        }
        const Correspondences pairs = corners.pairs();
        for (std::size_t i = 0; i < 14; ++i) EXPECT_EQ(pairs.weight[i], 0) << i;
        return std::count(pairs.weight.begin() + 14, pairs.weight.end(), 0.0F);
    };
    EXPECT_EQ(leftOut(3, 0), 0);
    EXPECT_EQ(leftOut(5, 0), 0) << "half";
    EXPECT_EQ(leftOut(6, 0), 4);
    EXPECT_EQ(leftOut(5, 1), 4) << "of what is too young nobody knows that it moves";
    EXPECT_EQ(leftOut(2, 3), 0);
}

TEST(CornerWeights, whatSticksToThePictureSaysNothingAndCrowdsNobody) {
    // Three that stick and one beside them in a cell, four in another, three alone.
    PlacedCorners corners;
    for (int i = 0; i < 3; ++i) corners.add(1 + float(i), 5).sticks = true;
    corners.add(8, 5);
    for (int i = 0; i < 4; ++i) corners.add(105 + float(i), 105);
    for (int i = 0; i < 3; ++i) corners.add(150 + 40 * float(i), 150);
    const Correspondences pairs = corners.pairs();
    ASSERT_EQ(pairs.size(), 11);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(pairs.weight[i], 0) << i;
    EXPECT_NEAR(pairs.weight[3], 1, 1e-6);
    for (std::size_t i = 4; i < 8; ++i) EXPECT_NEAR(pairs.weight[i], 2.0 / 4, 1e-6) << i;
    for (std::size_t i = 8; i < 11; ++i) EXPECT_NEAR(pairs.weight[i], 1, 1e-6) << i;
}

TEST(CornerWeights, aCellIsASixteenthOfThePictureAndWhatIsUsualIsItsMedian) {
    // 20 px: ten in the first cell, one just beyond it; both others alone.
    PlacedCorners first;
    for (int i = 0; i < 9; ++i) first.add(1 + float(i), 5);
    first.add(19.5F, 5);
    first.add(20.5F, 5);
    first.add(19.5F, 20.5F);
    const Correspondences pairs = first.pairs();
    for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(pairs.weight[i], 2.0 / 10, 1e-6) << i;
    EXPECT_NEAR(pairs.weight[10], 1, 1e-6);
    EXPECT_NEAR(pairs.weight[11], 1, 1e-6);
    // Nine in each of two cells, one in each of two others: of the two in the middle the larger counts.
    PlacedCorners even;
    for (int i = 0; i < 9; ++i) {
        even.add(1 + float(i), 5);
        even.add(101 + float(i), 105);
    }
    even.add(205, 5);
    even.add(205, 205);
    for (const float weight : even.pairs().weight) EXPECT_NEAR(weight, 1, 1e-6);
}

}  // namespace eyrie::corner_weights_test
