#include "imaging/region_boxes.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace eyrie::region_boxes_test {
namespace {

TEST(CloseGaps, BridgesTwoPixelsButNotThree) {
    cv::Mat binary = cv::Mat::zeros(9, 20, CV_8UC1);
    binary(cv::Rect(2, 3, 3, 3)).setTo(255);
    binary(cv::Rect(7, 3, 3, 3)).setTo(255);   // two columns apart
    binary(cv::Rect(13, 3, 3, 3)).setTo(255);  // three columns apart
    cv::Mat closed;
    closeGaps(binary, closed);
    EXPECT_EQ(closed.at<uchar>(4, 5), 255);
    EXPECT_EQ(closed.at<uchar>(4, 6), 255);
    EXPECT_EQ(closed.at<uchar>(4, 11), 0);
    cv::Mat labels;
    EXPECT_EQ(findRegions(closed, 1, labels).size(), 2U);
}

TEST(CloseGaps, NeverRemovesAndIsIdempotent) {
    cv::RNG random(2);
    cv::Mat noise(40, 30, CV_8UC1);
    random.fill(noise, cv::RNG::UNIFORM, 0, 256);
    const cv::Mat binary = noise > 200;
    cv::Mat once;
    cv::Mat twice;
    closeGaps(binary, once);
    closeGaps(once, twice);
    EXPECT_EQ(cv::countNonZero(binary & ~once), 0);
    EXPECT_EQ(cv::countNonZero(once != twice), 0);
}

TEST(FindRegions, BoxesComponentsThatTouchAtCorners) {
    cv::Mat binary = cv::Mat::zeros(12, 12, CV_8UC1);
    binary(cv::Rect(2, 2, 3, 2)).setTo(255);
    binary.at<uchar>(4, 5) = 255;  // touches at the corner
    binary(cv::Rect(9, 8, 3, 3)).setTo(255);
    cv::Mat labels;
    const auto regions = findRegions(binary, 1, labels);
    ASSERT_EQ(regions.size(), 2U);
    EXPECT_EQ(regions[0].box, cv::Rect(2, 2, 4, 3));
    EXPECT_EQ(regions[0].pixels, 7);
    EXPECT_FALSE(regions[0].cut);
    EXPECT_TRUE(regions[1].cut);
    EXPECT_EQ(labels.at<int>(9, 10), regions[1].label);
}

TEST(FindRegions, LeavesSmallBoxesOut) {
    cv::Mat binary = cv::Mat::zeros(12, 12, CV_8UC1);
    binary(cv::Rect(1, 1, 3, 3)).setTo(255);  // 9 px²
    binary(cv::Rect(6, 6, 5, 2)).setTo(255);  // 10 px²
    cv::Mat labels;
    const auto regions = findRegions(binary, 10, labels);
    ASSERT_EQ(regions.size(), 1U);
    EXPECT_EQ(regions[0].box, cv::Rect(6, 6, 5, 2));
}

TEST(BoxWithin, IsTheBoxOfTheRegionsOwnPixels) {
    cv::Mat binary = cv::Mat::zeros(10, 10, CV_8UC1);
    binary.col(4).setTo(255);
    binary(cv::Rect(4, 5, 3, 1)).setTo(255);
    cv::Mat labels;
    const auto regions = findRegions(binary, 1, labels);
    ASSERT_EQ(regions.size(), 1U);
    EXPECT_EQ(boxWithin(labels, regions[0], {2, 3, 6, 4}), cv::Rect(4, 3, 3, 4));
    EXPECT_TRUE(boxWithin(labels, regions[0], {7, 0, 2, 2}).empty());
    EXPECT_TRUE(boxWithin(labels, regions[0], {-9, -9, 2, 2}).empty());
    EXPECT_EQ(boxWithin(labels, regions[0], {4, 1, 3, 3}), cv::Rect(4, 1, 1, 3)) << "of its first column alone";
    EXPECT_EQ(boxWithin(labels, regions[0], {5, 5, 2, 1}), cv::Rect(5, 5, 2, 1));
    EXPECT_EQ(boxWithin(labels, regions[0], {6, 4, 4, 3}), cv::Rect(6, 5, 1, 1)) << "of one pixel";
}

TEST(FindRegions, TakesEmptyAndSinglePixels) {
    cv::Mat labels;
    EXPECT_TRUE(findRegions(cv::Mat(), 1, labels).empty());
    EXPECT_TRUE(findRegions(cv::Mat::zeros(1, 1, CV_8UC1), 1, labels).empty());
    EXPECT_EQ(findRegions(cv::Mat(1, 1, CV_8UC1, cv::Scalar(255)), 1, labels).size(), 1U);
    cv::Mat closed;
    closeGaps(cv::Mat(1, 1, CV_8UC1, cv::Scalar(255)), closed);
    EXPECT_EQ(closed.at<uchar>(0, 0), 255);
}

}  // namespace
}  // namespace eyrie::region_boxes_test
