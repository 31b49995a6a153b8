#include "stacking/stack_median.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <random>

#include "core/error.h"
#include "stacking/image_stack.h"
#include "stacking/selection_network.h"

namespace eyrie::stack_median_test {
namespace {

std::uint8_t sortedMedian(std::vector<std::uint8_t> values) {
    std::sort(values.begin(), values.end());
    return values[(values.size() - 1) / 2];
}

cv::Mat randomLayer(std::mt19937& random, cv::Size size, unsigned levels) {
    cv::Mat layer(size, CV_8UC1);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) layer.at<std::uint8_t>(y, x) = std::uint8_t(random() % levels);
    }
    return layer;
}

}  // namespace

TEST(SelectionNetwork, findsEveryRankOfEveryZeroOneInput) {
    // A network that selects right for all inputs of zeros and ones does so for all inputs.
    for (int count = 1; count <= 10; ++count) {
        for (int rank = 0; rank < count; ++rank) {
            const auto network = selectionNetwork(count, rank);
            for (unsigned bits = 0; bits < (1U << count); ++bits) {
                std::vector<int> values;
                for (int i = 0; i < count; ++i) values.push_back((bits >> i) & 1U);
                std::vector<int> sorted = values;
                std::sort(sorted.begin(), sorted.end());
                for (const auto& c : network) {
                    const int low = std::min(values[c.low], values[c.high]);
                    const int high = std::max(values[c.low], values[c.high]);
                    values[c.low] = c.keep_low ? low : -9;
                    values[c.high] = c.keep_high ? high : -9;
                }
                ASSERT_EQ(values[std::size_t(rank)], sorted[std::size_t(rank)]) << count << " " << rank << " " << bits;
            }
        }
    }
}

TEST(StackMedian, equalsASortedMedianBitByBit) {
    std::mt19937 random(3);
    StackMedian median;
    for (const std::size_t count : {1, 2, 3, 5, 7, 16, 25, 49, 50, 51, 64, 100}) {
        const std::size_t pixels = 301;  // no multiple of any vector length
        std::vector<std::vector<std::uint8_t>> layers(count, std::vector<std::uint8_t>(pixels));
        std::vector<const std::uint8_t*> pointers;
        for (auto& layer : layers) {
            for (auto& value : layer) value = std::uint8_t(random() % (count % 2 ? 256 : 5));
            pointers.push_back(layer.data());
        }
        std::vector<std::uint8_t> result(pixels);
        median.compute(pointers, pixels, result.data());
        for (std::size_t i = 0; i < pixels; ++i) {
            std::vector<std::uint8_t> values;
            for (const auto& layer : layers) values.push_back(layer[i]);
            ASSERT_EQ(result[i], sortedMedian(values)) << count << " layers, pixel " << i;
        }
    }
}

TEST(ImageStack, circularBufferForgetsTheOldest) {
    for (const auto arrangement : {StackArrangement::circular_mean, StackArrangement::circular_median}) {
        ImageStack stack(arrangement, {6, 4}, 3);
        for (const int grey : {250, 10, 20, 30}) stack.add(cv::Mat(4, 6, CV_8UC1, cv::Scalar(grey)));
        EXPECT_EQ(stack.height(), 3);
        EXPECT_EQ(stack.stacked().at<std::uint8_t>(2, 3), 20);
    }
}

TEST(ImageStack, accumulationIsTheMeanOfAllLayers) {
    ImageStack stack(StackArrangement::accumulation, {6, 4}, 3);
    for (const int grey : {250, 10, 20, 40}) stack.add(cv::Mat(4, 6, CV_8UC1, cv::Scalar(grey)));
    EXPECT_EQ(stack.height(), 4);
    EXPECT_EQ(stack.stacked().at<std::uint8_t>(0, 0), 80);
}

TEST(SelectionNetwork, holdsNoComparatorThatTheRankDoesNotNeed) {
    EXPECT_TRUE(selectionNetwork(1, 0).empty());
    EXPECT_EQ(selectionNetwork(2, 0).size(), 1U);
    EXPECT_EQ(selectionNetwork(3, 1).size(), 3U);
    EXPECT_EQ(selectionNetwork(4, 0).size(), 3U) << "a smallest of four needs three";
    for (const auto& c : selectionNetwork(16, 7)) EXPECT_TRUE(c.keep_low || c.keep_high);
    EXPECT_LE(selectionNetwork(16, 7).size(), 63U) << "Batcher's network sorts 16 with 63 comparators";
}

TEST(ImageStack, refusesLayersOfAnotherSizeAndHoldsAtLeastOne) {
    ImageStack stack(StackArrangement::circular_mean, {6, 4}, 0);
    EXPECT_THROW(stack.add(cv::Mat(6, 4, CV_8UC1, cv::Scalar(1))), Error);
    for (const int grey : {10, 20}) stack.add(cv::Mat(4, 6, CV_8UC1, cv::Scalar(grey)));
    EXPECT_EQ(stack.height(), 1);
    EXPECT_EQ(stack.stacked().at<std::uint8_t>(0, 0), 20);
}

TEST(ImageStack, aPartIsTheSameAsThePartOfTheWhole) {
    std::mt19937 random(5);
    ImageStack stack(StackArrangement::circular_median, {115, 345}, 20);
    for (int i = 0; i < 27; ++i) stack.add(randomLayer(random, {115, 345}, 256));
    const cv::Rect part(31, 100, 57, 120);
    EXPECT_EQ(cv::norm(stack.stacked(part), stack.stacked()(part), cv::NORM_INF), 0);
}

}  // namespace eyrie::stack_median_test
