#include "detection/segmenters/relative_connectivity.h"

#include <gtest/gtest.h>

#include "detection/segmenters/relative_connectivity_segmenter.h"
#include "support/driven_scene.h"

namespace eyrie::relative_connectivity_test {
namespace {

std::vector<int> scanned(const std::vector<int>& row, int min_points) {
    cv::Mat belonging(1, static_cast<int>(row.size()), CV_8UC1);
    for (int x = 0; x < belonging.cols; ++x) belonging.at<uchar>(x) = row[static_cast<std::size_t>(x)] != 0 ? 255 : 0;
    const cv::Mat accumulator = relativeConnectivity(belonging, min_points);
    return {accumulator.begin<int>(), accumulator.end<int>()};
}

/// Algorithm 1 as printed, for one row; outside the image nothing is set.
std::vector<int> asPrinted(const std::vector<int>& row, int min_points) {
    const int size = static_cast<int>(row.size());
    const auto set = [&](int x) { return x >= 0 && x < size && row[static_cast<std::size_t>(x)] != 0; };
    std::vector<int> accumulator(row.size(), 0);
    for (int x1 = 0; x1 < size; ++x1) {
        if (!set(x1)) continue;
        for (int x2 = x1 + 1; x2 <= x1 + (size - x1) / (min_points - 1); ++x2) {
            const int dx = x2 - x1;
            if (!set(x2) || set(x1 - dx)) continue;
            int xn = x2;
            int n = 2;
            while (set(xn + dx)) {
                ++n;
                xn += dx;
            }
            if (n < min_points) continue;
            accumulator[static_cast<std::size_t>(x1)] += n;
            accumulator[static_cast<std::size_t>(xn)] += n;
        }
    }
    return accumulator;
}

}  // namespace

TEST(RelativeConnectivity, HandWorkedRows) {
    // Step 1 joins five points from 1 to 5; step 2 joins 1, 3, 5; from 2 step 2 reaches 4 only, two points.
    EXPECT_EQ(scanned({0, 1, 1, 1, 1, 1, 0, 0}, 3), (std::vector<int>{0, 8, 0, 0, 0, 8, 0, 0}));
    // A gap ends the line of step 1, yet step 3 joins 0, 3, 6.
    EXPECT_EQ(scanned({1, 0, 0, 1, 0, 0, 1}, 3), (std::vector<int>{3, 0, 0, 0, 0, 0, 3}));
    EXPECT_EQ(scanned({0, 1, 1, 0}, 3), (std::vector<int>{0, 0, 0, 0}));
    EXPECT_EQ(scanned({0, 1, 1, 0}, 2), (std::vector<int>{0, 2, 2, 0}));
    EXPECT_EQ(scanned({1, 1, 1}, 3), (std::vector<int>{3, 0, 3}));
    EXPECT_EQ(scanned({0, 0, 0}, 3), (std::vector<int>{0, 0, 0}));
}

TEST(RelativeConnectivity, AgreesWithTheAlgorithmAsPrinted) {
    cv::RNG random(5);
    for (int i = 0; i < 300; ++i) {
        std::vector<int> row(static_cast<std::size_t>(random.uniform(1, 40)));
        for (int& point : row) point = random.uniform(0, 10) < 7 ? 1 : 0;
        const int min_points = random.uniform(2, 6);
        ASSERT_EQ(scanned(row, min_points), asPrinted(row, min_points));
    }
}

TEST(RelativeConnectivity, RowsAndColumnsAddUpAndTransposeAlike) {
    cv::Mat belonging = cv::Mat::zeros(9, 12, CV_8UC1);
    belonging(cv::Rect(3, 2, 5, 4)).setTo(255);
    const cv::Mat accumulator = relativeConnectivity(belonging, 3);
    const cv::Mat transposed = relativeConnectivity(belonging.t(), 3);
    EXPECT_EQ(cv::norm(accumulator, transposed.t(), cv::NORM_INF), 0);
    // Five points along the row (5 + 3), four along the column.
    EXPECT_EQ(accumulator.at<int>(2, 3), 12);
    EXPECT_EQ(accumulator.at<int>(2, 5), 4);  // on the upper side: an end of its column only
    EXPECT_EQ(accumulator.at<int>(3, 3), 8);
    EXPECT_EQ(accumulator.at<int>(3, 5), 0);  // inside
}

TEST(RelativeConnectivity, AnAreaThatIsScaledDownIsTheMeanOfItsPixels) {
    // A car of 46 px is made 15 px long, so that every third row and column would stay of a pattern of single ones.
    const SceneScale scale{0.1, 25, true};
    RelativeConnectivityOptions options;
    options.car_length = 46.0 / 3;
    options.low = 10;
    GradientOptions components;
    components.fall_back = false;
    const RelativeConnectivitySegmenter segmenter(options, components, scale, 0.5);
    MotionRoi roi;
    roi.image = cv::Mat(90, 120, CV_8UC1, cv::Scalar(90));
    roi.inside = cv::Mat(roi.image.size(), CV_8UC1, cv::Scalar(255));
    roi.image(cv::Rect(30, 30, 45, 18)).setTo(130);
    for (int y = 1; y < roi.image.rows; y += 3)
        for (int x = 1; x < roi.image.cols; x += 6) roi.image.at<uchar>(y, x) = 255;
    DetectionTrace trace;
    segmenter.detect(roi, &trace);
    for (const auto& layer : trace.layers) {
        if (layer.kind != TraceLayer::bright_areas) continue;
        EXPECT_GT(cv::mean(layer.image(cv::Rect(33, 33, 39, 12)))[0], 40) << "the bright place";
        EXPECT_EQ(cv::countNonZero(layer.image(cv::Rect(84, 0, 36, 90))), 0) << "nothing of the pattern beside it";
    }
}

TEST(RelativeConnectivity, DarkVehiclesAreFoundLikeBrightOnes) {
    auto bright = test::drivenScene(0.4);
    auto dark = bright;
    dark.frame.gray = 255 - bright.frame.gray;
    GradientOptions components;
    components.fall_back = false;
    const RelativeConnectivitySegmenter segmenter({}, components, test::kContractScale, 0.5);
    const auto a = segmenter.detect(test::roiOf(bright));
    const auto b = segmenter.detect(test::roiOf(dark));
    ASSERT_EQ(a.size(), b.size());
    ASSERT_FALSE(a.empty());
    EXPECT_GT(overlap(a[0].box, b[0].box), 0.9);
}

}  // namespace eyrie::relative_connectivity_test
