#include "motion/vectors/cell_means.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace eyrie::cell_means_test {
namespace {

TEST(CellMeans, AreThoseOfAnAreaOfThePicture) {
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(40, 30), cv::Size(1024, 540), cv::Size(301, 17)}) {
        cv::Mat gray(size, CV_8UC1);
        cv::RNG(7).fill(gray, cv::RNG::UNIFORM, 0, 256);
        for (const int block : {1, 3, 7, 13, 16}) {
            const cv::Size cells((size.width + block - 1) / block, (size.height + block - 1) / block);
            cv::Mat expected;
            cv::resize(gray, expected, cells, 0, 0, cv::INTER_AREA);
            const cv::Mat means = cellMeans(gray, cells);
            ASSERT_EQ(means.size(), cells);
            cv::Mat off;
            cv::absdiff(means, expected, off);
            // Halves may be rounded either way.
            EXPECT_LE(cv::countNonZero(off > 1), 0) << size << ' ' << block;
            EXPECT_LE(cv::countNonZero(off), 0.01 * cells.area()) << size << ' ' << block;
        }
    }
}

TEST(CellMeans, CountPartsOfPixels) {
    const cv::Mat gray = (cv::Mat_<uchar>(1, 3) << 100, 200, 10);
    const cv::Mat halves = cellMeans(gray, {2, 1});  // of one pixel and a half
    EXPECT_EQ(halves.at<uchar>(0), 133);
    EXPECT_EQ(halves.at<uchar>(1), 73);
    EXPECT_EQ(cellMeans(gray, {1, 1}).at<uchar>(0), 103);
    EXPECT_EQ(cellMeans(cv::Mat(90, 70, CV_8UC1, cv::Scalar(255)), {9, 11}).at<uchar>(10, 8), 255);
    EXPECT_THROW(cellMeans(gray, {4, 1}), cv::Exception);
    EXPECT_THROW(cellMeans(gray, {0, 1}), cv::Exception);
    EXPECT_THROW(cellMeans({}, {1, 1}), cv::Exception);
}

}  // namespace
}  // namespace eyrie::cell_means_test
