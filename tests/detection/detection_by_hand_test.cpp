/// Places and sizes in search areas, worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/geometry/angle.h"
#include "detection/motion_cluster_detector.h"
#include "detection/roi_cutter.h"
#include "detection/segmenters/component_boxes.h"
#include "detection/sliding_window/window_hypotheses.h"

namespace eyrie::detection_by_hand_test {
namespace {

using testing::SizeIs;

/// 20 × 30 px whose x runs down the picture: (x, y) lies at (100 − y, 50 + x).
MotionRoi turnedArea() {
    MotionRoi roi;
    roi.image = cv::Mat(30, 20, CV_8UC1);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 20; ++x) roi.image.at<uchar>(y, x) = static_cast<uchar>(8 * y + x % 8);
    roi.inside = cv::Mat(30, 20, CV_8UC1, cv::Scalar(255));
    roi.image_from_roi = {0, -1, 100, 1, 0, 50};
    roi.box = {{85.5, 59.5}, 30, 20, 0};
    roi.vectors = {{10, 20}, {14, 8}};
    roi.velocity = {2, 0.5};
    roi.cluster = 7;
    return roi;
}

}  // namespace

TEST(DetectionByHand, ABoxHoldsWhatLiesUpToItsMarginBesideEachSide) {
    const cv::Rect2d box(10, 20, 4, 6);
    const auto holds = [&](float x, float y) { return !pointsWithin(box, {{x, y}}, 1).empty(); };
    for (const auto& [x, y] : {std::pair(9.1F, 22.F), {14.9F, 22.F}, {12.F, 19.1F}, {12.F, 26.9F}, {9.1F, 19.1F}})
        EXPECT_TRUE(holds(x, y)) << x << ", " << y;
    for (const auto& [x, y] : {std::pair(8.9F, 22.F), {15.1F, 22.F}, {12.F, 18.9F}, {12.F, 27.1F}})
        EXPECT_FALSE(holds(x, y)) << x << ", " << y;
    EXPECT_TRUE(holds(9, 19)) << "the margin's own edge belongs to it";
    EXPECT_TRUE(holds(15, 27));
}

TEST(DetectionByHand, ABoxIsSupportedByItsShareAndByOneAtLeast) {
    const cv::Rect2d box(10, 20, 4, 6);
    std::vector<cv::Point2f> vectors(8, cv::Point2f(500, 500));
    vectors.emplace_back(12.F, 22.F);
    vectors.emplace_back(9.2F, 22.F);  // a pixel beside counts
    EXPECT_EQ(supportOf(box, vectors, 0.2).inside, 2);
    EXPECT_DOUBLE_EQ(supportOf(box, vectors, 0.2).needed, 2);
    EXPECT_TRUE(supportOf(box, vectors, 0.2).enough());
    EXPECT_FALSE(supportOf(box, vectors, 0.25).enough()) << "2.5 of ten";
    EXPECT_DOUBLE_EQ(supportOf(box, vectors, 0).needed, 1);
    EXPECT_FALSE(supportOf(box, {}, 0).enough());
}

TEST(DetectionByHand, AClusterIsDetectedAsTheBoxOfItsVectorsInThePicture) {
    const MotionRoi roi = turnedArea();
    const auto found = clusterDetection(roi, 0.5);
    ASSERT_THAT(found, SizeIs(1));
    // x from 10 to 14, y from 8 to 20, and half a pixel: its middle (12, 14) lies at (86, 62), and up is to the right.
    EXPECT_EQ(found[0].box.centre, cv::Point2d(86, 62));
    EXPECT_DOUBLE_EQ(found[0].box.length, 13);
    EXPECT_DOUBLE_EQ(found[0].box.width, 5);
    EXPECT_NEAR(found[0].box.heading, 0, 1e-12);
    EXPECT_EQ(found[0].velocity, cv::Point2d(2, 0.5));
    EXPECT_EQ(found[0].cluster, 7);
    MotionRoi empty = roi;
    empty.vectors.clear();
    EXPECT_THAT(clusterDetection(empty, 0.5), SizeIs(0));
}

TEST(DetectionByHand, TheMiddleOfATurnedAreaShowsTheSamePlaces) {
    const MotionRoi roi = turnedArea();
    const MotionRoi middle = narrowed(roi, 4);
    EXPECT_EQ(middle.image.size(), cv::Size(12, 22));
    EXPECT_EQ(middle.image.at<uchar>(0, 0), roi.image.at<uchar>(4, 4));
    EXPECT_EQ(middle.image.at<uchar>(21, 11), roi.image.at<uchar>(25, 15));
    EXPECT_EQ(middle.image_from_roi, cv::Matx23d(0, -1, 96, 1, 0, 54))
        << "its first pixel is (4, 4): (100 − 4, 50 + 4)";
    EXPECT_EQ(middle.vectors[0], cv::Point2f(6, 16));
    EXPECT_EQ(middle.vectors[1], cv::Point2f(10, 4));
    EXPECT_DOUBLE_EQ(middle.box.length, 22);
    EXPECT_DOUBLE_EQ(middle.box.width, 12);
    EXPECT_EQ(middle.box.centre, roi.box.centre);
}

TEST(DetectionByHand, AnAreaIsRescaledUntilACarTakesItsPartOfTheWindow) {
    SlidingWindowOptions options;
    options.car_length_m = 4.3;
    options.car_width_m = 2;
    const SceneScale scene{0.2, 25, true};  // 21.5 × 10 px
    EXPECT_EQ(rescaledSize({60, 100}, 1, options, scene), cv::Size(60, 100));
    EXPECT_EQ(rescaledSize({60, 100}, 1, options, scene, WindowFit::filled()), cv::Size(96, 149))
        << "60 · 16 / 10 by 100 · 32 / 21.5";
    EXPECT_EQ(rescaledSize({60, 100}, 2, options, scene, WindowFit::filled()), cv::Size(96, 74));
    EXPECT_EQ(rescaledSize({60, 100}, 1, options, {0.1, 25, true}), cv::Size(30, 50)) << "twice as fine";
    EXPECT_EQ(rescaledSize({3, 3}, 100, options, scene).height, 1) << "a pixel at least";
}

}  // namespace eyrie::detection_by_hand_test
