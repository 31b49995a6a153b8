#include "removal/outlier_removal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "removal/vectors_in_boxes.h"

namespace eyrie {
namespace {

using namespace test;

TEST(OutlierRemoval, ThesisDemandsFourVectorsWhateverTheDensity) {
    FrameMotion motion = sparseMotion();
    fill(motion, {{100, 100}, 18, 7, 0}, 4);
    fill(motion, {{200, 100}, 18, 7, 0}, 3);
    const auto found =
        removeOutliers({detection(100, 100, 18, 7), detection(200, 100, 18, 7), detection(300, 100, 18, 7)}, motion,
                       OutlierRemovalOptions::thesis(), kScale);
    EXPECT_EQ(found[0].rejection, Rejection::none);
    EXPECT_EQ(found[1].rejection, Rejection::outlier);
    EXPECT_EQ(found[2].rejection, Rejection::outlier);
    EXPECT_EQ(found[1].vectors.size(), 3U);
}

TEST(OutlierRemoval, DefaultFollowsTheDensity) {
    FrameMotion motion = sparseMotion();
    fill(motion, {{100, 100}, 18, 7, 0}, 5);
    // 88,889 corners in 640 × 480: 0.289 per px², 37.5 on a car of 129.6 px²; a quarter of that is 9.
    motion.corner_count = 88889;
    EXPECT_EQ(removeOutliers({detection(100, 100, 18, 7)}, motion, {}, kScale)[0].rejection, Rejection::outlier);
    fill(motion, {{100, 101}, 18, 7, 0}, 4);
    EXPECT_EQ(removeOutliers({detection(100, 100, 18, 7)}, motion, {}, kScale)[0].rejection, Rejection::none);
}

TEST(OutlierRemoval, ScoreIsVectorsPerExpectedVector) {
    FrameMotion motion = sparseMotion();
    motion.corner_count = 30720;  // 0.1 per px²
    fill(motion, {{100, 100}, 20, 10, 0}, 10);
    const auto found = removeOutliers({detection(100, 100, 20, 10)}, motion, {}, kScale);
    EXPECT_NEAR(found[0].score, 10 / 20.0, 1e-9);
    Detection classified = detection(100, 100, 20, 10);
    classified.score = 0.87;
    EXPECT_DOUBLE_EQ(removeOutliers({classified}, motion, {}, kScale)[0].score, 0.87);
}

TEST(OutlierRemoval, RejectsImpossibleSizes) {
    FrameMotion motion = sparseMotion();
    fill(motion, {{100, 100}, 400, 7, 0}, 200);
    const auto rejection = [&](double length, double width) {
        return removeOutliers({detection(100, 100, length, width)}, motion, {}, kScale)[0].rejection;
    };
    EXPECT_EQ(rejection(18, 7), Rejection::none);
    EXPECT_EQ(rejection(9, 1), Rejection::size);    // below 10 px²
    EXPECT_EQ(rejection(4.5, 7), Rejection::size);  // 1.1 m
    EXPECT_EQ(rejection(130, 9), Rejection::size);  // 32 m
    EXPECT_EQ(rejection(40, 44), Rejection::size);  // 11 m wide
    EXPECT_EQ(rejection(std::nan(""), 7), Rejection::outlier) << "and nothing breaks";
}

TEST(OutlierRemoval, ThesisCountsVectorsOfAnyVelocity) {
    FrameMotion motion = sparseMotion();
    fill(motion, {{100, 100}, 18, 7, 0}, 4, {-1, 0});
    EXPECT_EQ(
        removeOutliers({detection(100, 100, 18, 7)}, motion, OutlierRemovalOptions::thesis(), kScale)[0].rejection,
        Rejection::none);
    EXPECT_EQ(removeOutliers({detection(100, 100, 18, 7)}, motion, {}, kScale)[0].rejection, Rejection::outlier);
}

TEST(OutlierRemoval, LeavesEarlierRejectionsAlone) {
    Detection gone = detection(100, 100, 18, 7);
    gone.rejection = Rejection::duplicate;
    EXPECT_EQ(removeOutliers({gone}, sparseMotion(), {}, kScale)[0].rejection, Rejection::duplicate);
    EXPECT_TRUE(removeOutliers({}, {}, {}, kScale).empty());
}

}  // namespace
}  // namespace eyrie
