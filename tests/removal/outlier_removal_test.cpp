#include "removal/outlier_removal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/geometry/angle.h"
#include "removal/vectors_in_boxes.h"

namespace eyrie::outlier_removal_test {
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

TEST(OutlierRemoval, MaxMinVectorsIsEnoughHoweverDenseTheCornersAre) {
    FrameMotion motion = sparseMotion();
    fill(motion, {{100, 100}, 18, 7, 0}, 14);
    motion.corner_count = 200000;  // 84 on a car, a quarter of that is 21
    const auto rejection = [&](const char* most) {
        OutlierRemovalOptions options;
        setParameter(describeOf(options), "outliers.max_min_vectors", most);
        return removeOutliers({detection(100, 100, 18, 7)}, motion, options, kScale)[0].rejection;
    };
    EXPECT_EQ(rejection("12"), Rejection::none);
    EXPECT_EQ(rejection("14"), Rejection::none);
    EXPECT_EQ(rejection("15"), Rejection::outlier);
    EXPECT_EQ(rejection("1000"), Rejection::outlier);
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

TEST(OutlierRemoval, SaysWhichLimitIsBroken) {
    const auto broken = [](double length, double width, const OutlierRemovalOptions& options) {
        return brokenSizeLimit({{100, 100}, length, width, 0}, options, kScale);
    };
    struct Case {
        double length, width;
        const char* parameter;
        double value, limit;
        bool at_most;
    };
    for (const Case& c :
         {Case{4.9, 2, "outliers.min_area", 9.8, 10, false}, Case{4.7, 7, "outliers.min_length", 4.7, 4.8, false},
          Case{120.1, 9, "outliers.max_length", 120.1, 120, true},
          Case{50, 40.1, "outliers.max_width", 40.1, 40, true}}) {
        const auto found = broken(c.length, c.width, {});
        ASSERT_TRUE(found) << c.parameter;
        EXPECT_EQ(found->parameter, c.parameter);
        EXPECT_NEAR(found->value, c.value, 1e-9) << c.parameter;
        EXPECT_NEAR(found->limit, c.limit, 1e-9) << c.parameter;
        EXPECT_EQ(found->at_most, c.at_most) << c.parameter;
    }
    EXPECT_FALSE(broken(5, 2, {})) << "10 px² are enough";
    EXPECT_FALSE(broken(4.8, 7, {})) << "1.2 m are enough";
    EXPECT_FALSE(broken(120, 40, {})) << "30 × 10 m are possible";
    const OutlierRemovalOptions thesis = OutlierRemovalOptions::thesis();
    EXPECT_FALSE(broken(400, 300, thesis)) << "the thesis limits the area only";
    EXPECT_FALSE(broken(4, 2.5, thesis));
    EXPECT_TRUE(broken(4, 2.4, thesis));
}

TEST(OutlierRemoval, SaysOfADetectionWhatItDecided) {
    FrameMotion motion = sparseMotion();
    fill(motion, {{100, 100}, 400, 7, 0}, 200);
    OutlierRemovalOptions options;
    options.min_density_share = 0;
    const auto removedAs = [&](const Detection& one) {
        const Detection removed = removeOutliers({one}, motion, options, kScale)[0];
        const RemovalVerdict why = whyRemoved(removed, motion, options, kScale);
        EXPECT_EQ(why.rejection, removed.rejection);
        return why;
    };
    const RemovalVerdict kept = removedAs(detection(100, 100, 18, 7));
    EXPECT_EQ(kept.parameter, "outliers.min_vectors");
    EXPECT_GE(kept.value, kept.limit);
    EXPECT_EQ(removedAs(detection(500, 400, 18, 7)).parameter, "outliers.min_vectors") << "no vector is there";
    const RemovalVerdict large = removedAs(detection(100, 100, 130, 9));
    EXPECT_EQ(large.parameter, "outliers.max_length");
    EXPECT_NEAR(large.value, 130, 1e-9);
    EXPECT_NEAR(large.limit, 120, 1e-9);
    EXPECT_TRUE(large.at_most);
    options.min_vectors = 0;
    options.min_density_share = 2;
    motion.corner_count = 200000;
    EXPECT_EQ(removedAs(detection(100, 100, 18, 7)).parameter, "outliers.min_density_share");
    // What others rejected is not judged.
    Detection duplicate = detection(100, 100, 130, 9);
    duplicate.rejection = Rejection::duplicate;
    const RemovalVerdict other = whyRemoved(duplicate, motion, options, kScale);
    EXPECT_EQ(other.rejection, Rejection::duplicate);
    EXPECT_TRUE(other.parameter.empty());
}

TEST(OutlierRemoval, LimitsInMetresAreThoseOfThePlace) {
    SceneScale scale = kScale;
    scale.slope = ScaleSlope::ofPicture({640, 480}, 0, 0.003);
    const cv::Point2d above(100, 100);
    const double factor = scale.slope.factorAt(above);
    ASSERT_LT(factor, 0.6);
    const auto lengthLimit = [&](double length) { return brokenSizeLimit({above, length, 7, 0}, {}, scale); };
    EXPECT_FALSE(lengthLimit(119 * factor)) << "30 m are 120 px in the middle";
    ASSERT_TRUE(lengthLimit(121 * factor));
    EXPECT_NEAR(lengthLimit(121 * factor)->limit, 120 * factor, 1e-9);
    // 9 vectors on a box: enough for a small car far away where 12 are needed near by.
    FrameMotion motion = sparseMotion();
    motion.corner_count = 200000;
    fill(motion, {above, 20, 8, 0}, 9);
    const auto rejection = [&](const SceneScale& of) {
        return removeOutliers({detection(above.x, above.y, 18, 7)}, motion, {}, of)[0].rejection;
    };
    EXPECT_EQ(rejection(kScale), Rejection::outlier);
    EXPECT_EQ(rejection(scale), Rejection::none);
}

TEST(OutlierRemoval, VectorsNeededGrowWithTheDensityWithinLimits) {
    const auto needed = [](int corners, const OutlierRemovalOptions& options) {
        FrameMotion motion = sparseMotion();
        motion.corner_count = corners;
        return vectorsNeeded(motion, options, kScale);
    };
    // On a car of 129.6 px² in 307,200: 47,407 corners are 20 on a car.
    EXPECT_EQ(needed(0, {}), 3);
    EXPECT_EQ(needed(47407, {}), 5);
    EXPECT_EQ(needed(61000, {}), 6) << "6.4";
    EXPECT_EQ(needed(64000, {}), 7) << "6.75";
    EXPECT_EQ(needed(200000, {}), 12) << "however dense";
    EXPECT_EQ(needed(200000, OutlierRemovalOptions::thesis()), 4);
}

TEST(OutlierRemoval, TheScoreOfAnOddSizeIsThatOfHalfOrTwoCars) {
    const auto scoreOf = [](double length, double width, int corners, double score) {
        FrameMotion motion = sparseMotion();
        motion.corner_count = corners;
        fill(motion, {{100, 100}, 10, 5, 0}, 10);
        Detection judged = detection(100, 100, length, width);
        judged.score = score;
        return removeOutliers({judged}, motion, {}, kScale)[0].score;
    };
    EXPECT_NEAR(scoreOf(10, 5, 30720, 0), 10 / 6.48, 1e-9) << "half a car is 64.8 px²";
    EXPECT_NEAR(scoreOf(40, 20, 30720, 0), 10 / 25.92, 1e-9) << "two cars are 259.2 px²";
    EXPECT_NEAR(scoreOf(40, 20, 30, 0), 10, 1e-9) << "at least one vector is expected";
    EXPECT_NEAR(scoreOf(40, 20, 30, -2), 10, 1e-9);
    EXPECT_EQ(scoreOf(40, 20, 30, 0.01), 0.01);
}

TEST(OutlierRemoval, ThesisCountsVectorsOfAnyVelocity) {
    FrameMotion motion = sparseMotion();
    fill(motion, {{100, 100}, 18, 7, 0}, 4, {-1, 0});
    EXPECT_EQ(
        removeOutliers({detection(100, 100, 18, 7)}, motion, OutlierRemovalOptions::thesis(), kScale)[0].rejection,
        Rejection::none);
    EXPECT_EQ(removeOutliers({detection(100, 100, 18, 7)}, motion, {}, kScale)[0].rejection, Rejection::outlier);
}

TEST(OutlierRemoval, ThesisCountsNoVectorsBesideTheBox) {
    FrameMotion motion = sparseMotion();
    fill(motion, {{100, 104}, 18, 7, 0}, 4);  // 0.5 px outside a box that ends at y = 103.5
    const Detection box = detection(100, 100, 18, 7);
    EXPECT_EQ(removeOutliers({box}, motion, {}, kScale)[0].rejection, Rejection::none);
    EXPECT_EQ(removeOutliers({box}, motion, OutlierRemovalOptions::thesis(), kScale)[0].rejection, Rejection::outlier);
}

TEST(OutlierRemoval, VectorsOnTheVeryBorderAreInside) {
    // The box of a cluster ends on its outermost vectors, which come back through rotations.
    for (int turn = 0; turn < 40; ++turn) {
        FrameMotion motion = sparseMotion();
        OrientedBox box{{211.3 + 0.7 * turn, 187.9 + 0.3 * turn}, 18, 7, 0.157 * turn};
        for (const cv::Point2d in_box : {cv::Point2d(9, 1), cv::Point2d(-9, 2), cv::Point2d(3, 3.5), {-2, -3.5}}) {
            motion.motion_vectors.push_back(
                {static_cast<CornerId>(motion.motion_vectors.size()), box.toImage(in_box), {1, 0}, 9});
        }
        Detection found;
        found.box = box;
        found.velocity = {1, 0};
        const auto kept = removeOutliers({found}, motion, OutlierRemovalOptions::thesis(), kScale);
        EXPECT_EQ(kept[0].rejection, Rejection::none) << turn;
        EXPECT_EQ(kept[0].vectors.size(), 4U) << turn;
    }
}

TEST(OutlierRemoval, ThesisRejectsWhatReachesBeyondTheImage) {
    FrameMotion motion = sparseMotion();  // 640 × 480: edges at −0.5, 639.5 and 479.5
    const auto rejection = [&](const OrientedBox& box, const OutlierRemovalOptions& options) {
        FrameMotion with_vectors = motion;
        fill(with_vectors, {box.centre, 4, 1, 0}, 6);
        Detection found;
        found.box = box;
        found.velocity = {1, 0};
        return removeOutliers({found}, with_vectors, options, kScale)[0].rejection;
    };
    const OutlierRemovalOptions thesis = OutlierRemovalOptions::thesis();
    const std::vector<OrientedBox> inside{
        {{8.5, 100}, 18, 7, 0},       {{630.5, 100}, 18, 7, 0}, {{100, 3}, 18, 7, 0},    {{100, 476}, 18, 7, 0},
        {{100, 8.5}, 18, 7, kPi / 2}, {{8.5, 100}, 18, 7, kPi}, {{320, 240}, 18, 7, 0.8}};
    for (const OrientedBox& box : inside) EXPECT_EQ(rejection(box, thesis), Rejection::none) << box.centre;
    const std::vector<OrientedBox> beyond{{{7.5, 100}, 18, 7, 0},
                                          {{8.4, 100}, 18, 7, 0},
                                          {{630.6, 100}, 18, 7, 0},
                                          {{100, 2.9}, 18, 7, 0},
                                          {{100, 476.1}, 18, 7, 0},
                                          {{631.5, 100}, 18, 7, 0},
                                          {{100, 2}, 18, 7, 0},
                                          {{100, 477}, 18, 7, 0},
                                          // Turned by 45° it reaches (18 + 7) / √8 = 8.8 px to every side.
                                          {{8, 100}, 18, 7, kPi / 4}};
    for (const OrientedBox& box : beyond) {
        EXPECT_EQ(rejection(box, thesis), Rejection::size) << box.centre;
        EXPECT_EQ(rejection(box, {}), Rejection::none) << box.centre;
        const auto limit = brokenSizeLimit(box, thesis, kScale, motion.image_size);
        ASSERT_TRUE(limit);
        EXPECT_EQ(limit->parameter, "outliers.inside_image");
        EXPECT_LT(limit->value, 1);
        EXPECT_GT(limit->value, 0.7);
        EXPECT_FALSE(brokenSizeLimit(box, thesis, kScale)) << "without a picture there is no outside";
    }
}

TEST(OutlierRemoval, LeavesEarlierRejectionsAlone) {
    Detection gone = detection(100, 100, 18, 7);
    gone.rejection = Rejection::duplicate;
    EXPECT_EQ(removeOutliers({gone}, sparseMotion(), {}, kScale)[0].rejection, Rejection::duplicate);
    EXPECT_TRUE(removeOutliers({}, {}, {}, kScale).empty());
}

}  // namespace
}  // namespace eyrie::outlier_removal_test
