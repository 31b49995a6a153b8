#include "stacking/stack_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>
#include <thread>

#include "imaging/upright_patch.h"
#include "stacking/image_stack.h"

namespace eyrie::stack_layer_test {
namespace {

const cv::Size kArea(115, 345);

/// Smooth ground, so that sampling places that differ by a rounding step differ little.
cv::Mat smoothPicture() {
    cv::Mat picture(300, 400, CV_8UC1);
    for (int y = 0; y < picture.rows; ++y) {
        for (int x = 0; x < picture.cols; ++x)
            picture.at<std::uint8_t>(y, x) =
                cv::saturate_cast<std::uint8_t>(128 + 80 * std::sin(x / 20.0) * std::cos(y / 15.0));
    }
    return picture;
}

cv::Matx23d mapAt(cv::Point2d centre, double heading) {
    return imageFromPatch({centre, double(kArea.height), double(kArea.width), heading}, kArea);
}

cv::Mat cutAtOnce(const cv::Mat& gray, const cv::Matx23d& image_from_stack) {
    cv::Mat pixels;
    cv::warpAffine(gray, pixels, image_from_stack, kArea, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT,
                   cv::Scalar(kOutsideGrey));
    return pixels;
}

/// All tiles side by side, by way of a stack of one layer.
cv::Mat inTiles(const cv::Mat& gray, const cv::Matx23d& image_from_stack) {
    ImageStack stack(StackArrangement::circular_median, kArea, 1);
    stack.add(StackLayer(gray, image_from_stack, kArea));
    return stack.stacked();
}

}  // namespace

TEST(StackLayer, tilesFitTogetherToTheAreaCutAtOnce) {
    const cv::Mat gray = smoothPicture();
    for (const double heading : {0.0, 0.4, 1.9, std::numbers::pi, 5.1}) {
        const cv::Matx23d map = mapAt({200.3, 149.6}, heading);
        EXPECT_LE(cv::norm(inTiles(gray, map), cutAtOnce(gray, map), cv::NORM_INF), 3) << heading;
        const cv::Rect part(20, 101, 77, 130);
        EXPECT_LE(cv::norm(StackLayer(gray, map, kArea).cut(part), cutAtOnce(gray, map)(part), cv::NORM_INF), 3);
    }
}

TEST(StackLayer, isGreyOutsideTheImage) {
    StackLayer layer(cv::Mat(40, 40, CV_8UC1, cv::Scalar(200)), mapAt({20, 20}, -std::numbers::pi / 2), kArea);
    const cv::Mat whole = layer.cut({{0, 0}, kArea});
    EXPECT_EQ(whole.at<std::uint8_t>(0, 0), kOutsideGrey);
    EXPECT_EQ(whole.at<std::uint8_t>(172, 57), 200);
    EXPECT_EQ(whole.at<std::uint8_t>(344, 114), kOutsideGrey);
    EXPECT_EQ(layer.tile({0, 0}).at<std::uint8_t>(0, 0), kOutsideGrey);
}

TEST(StackLayer, pixelsDoNotDependOnWhatWasAskedForBefore) {
    const cv::Mat gray = smoothPicture();
    const cv::Matx23d map = mapAt({190, 160}, 0.7);
    StackLayer layer(gray, map, kArea);
    const cv::Mat tile = layer.tile({1, 3}).clone();
    EXPECT_EQ(tile.size(), cv::Size(kArea.width - 64, 64)) << "the last column is narrower";
    EXPECT_EQ(cv::norm(tile, inTiles(gray, map)(StackLayer::tileRect({1, 3}, kArea)), cv::NORM_INF), 0);
}

TEST(StackLayer, aStackMayBeSearchedByThreadsAtOnce) {
    for (const auto arrangement : {StackArrangement::circular_mean, StackArrangement::circular_median}) {
        const auto filled = [&](unsigned seed) {
            std::mt19937 place(seed);
            ImageStack stack(arrangement, kArea, 20);
            for (int i = 0; i < 27; ++i) {
                stack.add(StackLayer(smoothPicture(), mapAt({150.0 + place() % 100, 150}, place() % 6), kArea));
            }
            return stack;
        };
        const ImageStack alone = filled(3);
        const cv::Mat whole = alone.stacked();
        const ImageStack shared = filled(3);
        std::vector<std::jthread> threads;
        std::vector<cv::Mat> parts(4);
        const auto partOf = [](int i) { return cv::Rect(10 + i, 30 * i, 100, 200); };
        for (int i = 0; i < 4; ++i) {
            threads.emplace_back([&, i] { parts[std::size_t(i)] = shared.stacked(partOf(i)); });
        }
        threads.clear();
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(cv::norm(parts[std::size_t(i)], whole(partOf(i)), cv::NORM_INF), 0);
        }
    }
}

}  // namespace eyrie::stack_layer_test
