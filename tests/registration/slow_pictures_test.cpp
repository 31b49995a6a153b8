// Measures of pictures against slow ones that follow the words of their descriptions.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "registration/pictures/image_pyramid.h"
#include "registration/pictures/noise_level.h"
#include "registration/pictures/padding_mask.h"
#include "registration/pictures/picture_difference.h"
#include "support/textured_ground.h"

namespace eyrie::slow_pictures_test {
namespace {

PaddedPicture padded(const cv::Mat& gray) {
    PaddedPicture picture;
    picture.copyFrom(gray);
    return picture;
}

cv::Mat random(cv::Size size, unsigned seed, int least = 0, int most = 255) {
    std::mt19937 numbers(seed);
    cv::Mat_<std::uint8_t> gray(size);
    for (std::uint8_t& value : gray) value = std::uint8_t(least + int(numbers() % unsigned(most - least + 1)));
    return gray;
}

const cv::Size kSizes[] = {{1, 1}, {2, 3}, {3, 2}, {16, 16}, {17, 31}, {63, 40}, {64, 9}, {65, 48}, {97, 71}, {130, 3}};

/// The lower quartile of |response| of every row_step-th row and column_step-th column, each whole-numbered response
/// spread evenly over the numbers that are rounded to it.
double slowNoise(const cv::Mat& gray, int row_step, int column_step) {
    std::vector<int> responses;
    const int mask[3][3] = {{1, -2, 1}, {-2, 4, -2}, {1, -2, 1}};
    for (int y = 1; y + 1 < gray.rows; y += row_step) {
        for (int x = 1; x + 1 < gray.cols; x += column_step) {
            int sum = 0;
            for (int j = 0; j < 3; ++j) {
                for (int i = 0; i < 3; ++i) sum += mask[j][i] * gray.at<std::uint8_t>(y + j - 1, x + i - 1);
            }
            responses.push_back(std::min(std::abs(sum), 511));
        }
    }
    if (responses.empty()) return 0.5;
    std::sort(responses.begin(), responses.end());
    const std::size_t wanted = responses.size() / 4;
    const int value = responses[wanted];
    const auto range = std::equal_range(responses.begin(), responses.end(), value);
    const double share =
        double(std::ptrdiff_t(wanted) - (range.first - responses.begin())) / double(range.second - range.first);
    const double quartile = value == 0 ? 0.5 * share : value - 0.5 + share;
    return std::max(0.5, quartile / 6 / 0.3186);
}

}  // namespace

TEST(SlowPictures, HalvesAreMeansOfFourAndLeaveOutAnOddLine) {
    for (const cv::Size size : kSizes) {
        if (size.width < 2 || size.height < 2) continue;
        const cv::Mat gray = random(size, 3);
        PaddedPicture half;
        halve(padded(gray), half);
        ASSERT_EQ(cv::Size(half.width(), half.height()), cv::Size(size.width / 2, size.height / 2));
        for (int y = 0; y < half.height(); ++y) {
            for (int x = 0; x < half.width(); ++x) {
                EXPECT_EQ(int(half.row(y)[x]), int(std::floor(cv::mean(gray(cv::Rect(2 * x, 2 * y, 2, 2)))[0] + 0.5)));
            }
        }
    }
}

TEST(SlowPictures, SmoothingIsTheBinomialMaskAndTheBorderRepeats) {
    for (const cv::Size size : kSizes) {
        const cv::Mat gray = random(size, 4);
        cv::Mat wide;
        cv::copyMakeBorder(gray, wide, 1, 1, 1, 1, cv::BORDER_REPLICATE);
        PaddedPicture smooth;
        smoothe(padded(gray), smooth);
        ASSERT_EQ(cv::Size(smooth.width(), smooth.height()), size);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                int sum = 0;
                for (int j = 0; j < 3; ++j) {
                    for (int i = 0; i < 3; ++i)
                        sum += (i == 1 ? 2 : 1) * (j == 1 ? 2 : 1) * wide.at<std::uint8_t>(y + j, x + i);
                }
                ASSERT_EQ(int(smooth.row(y)[x]), (sum + 8) / 16) << size << x << " " << y;
            }
        }
    }
}

TEST(SlowPictures, RowsAreReadableSixtyFourPixelsBeyondTheirEnd) {
    for (const cv::Size size : kSizes) {
        const cv::Mat gray = random(size, 5);
        const PaddedPicture picture = padded(gray);
        EXPECT_GE(picture.stride(), size.width + PaddedPicture::kOverread);
        EXPECT_LE(picture.stride(), size.width + PaddedPicture::kOverread + 63);
        EXPECT_EQ(picture.stride() % 64, 0);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) ASSERT_EQ(picture.row(y)[x], gray.at<std::uint8_t>(y, x));
        }
    }
}

TEST(SlowPictures, EveryLevelHalvesTheOneBefore) {
    ImagePyramid pyramid;
    const cv::Mat gray = random({390, 301}, 6);
    pyramid.build(gray);
    ASSERT_EQ(pyramid.levels(), 4);
    for (int level = 1; level < pyramid.levels(); ++level) {
        PaddedPicture half;
        halve(pyramid.level(level - 1), half);
        ASSERT_EQ(pyramid.level(level).width(), 390 >> level);
        for (int y = 0; y < half.height(); ++y)
            EXPECT_TRUE(std::equal(half.row(y), half.row(y) + half.width(), pyramid.level(level).row(y)));
    }
}

TEST(SlowPictures, NoiseIsTheLowerQuartileOfTheMasksMagnitude) {
    // Rows are left out from 320 on, columns beyond 320.
    const struct {
        cv::Size size;
        int row_step, column_step;
    } cases[] = {{{40, 30}, 1, 1},  {{320, 60}, 1, 1},  {{321, 60}, 1, 2},       {{61, 319}, 1, 1},
                 {{61, 320}, 2, 1}, {{330, 485}, 3, 2}, {{20, 16 * 160}, 16, 1}, {{20, 18 * 160}, 16, 1},
                 {{3, 3}, 1, 1},    {{2, 9}, 1, 1}};
    for (const auto& one : cases) {
        for (const int most : {0, 1, 3, 12, 255}) {
            // Rows differ, so that leaving out others would tell.
            cv::Mat gray = random(one.size, unsigned(most + 7), 0, most);
            for (int y = 0; y < gray.rows; y += 3) gray.row(y) = gray.row(y) / 3;
            for (int x = 0; x < gray.cols; x += 5) gray.col(x) = gray.col(x) / 2;
            EXPECT_NEAR(noiseLevel(padded(gray)), slowNoise(gray, one.row_step, one.column_step), 1e-9)
                << one.size << " " << most;
        }
    }
}

TEST(SlowPictures, NoiseBeyondAllMeasureIsNoMoreThanTheLargestResponse) {
    cv::Mat_<std::uint8_t> board(30, 40);
    for (int y = 0; y < board.rows; ++y) {
        for (int x = 0; x < board.cols; ++x) board(y, x) = (x + y) % 2 == 0 ? 255 : 0;
    }
    EXPECT_NEAR(noiseLevel(padded(board)), slowNoise(board, 1, 1), 1e-9);
    EXPECT_NEAR(noiseLevel(padded(board)), 510.75 / (6 * 0.3186), 1e-9);
}

TEST(SlowPictures, DifferencesAreMeansOverThePictureAndTiles) {
    for (const cv::Size size : kSizes) {
        const cv::Mat a = random(size, 8);
        const cv::Mat b = random(size, 9, 0, 90);
        cv::Mat apart;
        cv::absdiff(a, b, apart);
        double worst = 0;
        for (int top = 0; top < size.height; top += 16) {
            for (int left = 0; left < size.width; left += 16) {
                const cv::Rect tile = cv::Rect(left, top, 16, 16) & cv::Rect({0, 0}, size);
                if (tile.area() >= 64) worst = std::max(worst, cv::mean(apart(tile))[0]);
            }
        }
        const PictureDifference found = difference(padded(a), padded(b));
        EXPECT_NEAR(found.mean, cv::mean(apart)[0], 1e-9) << size;
        EXPECT_NEAR(found.worst_tile, worst, 1e-9) << size;
    }
}

TEST(SlowPictures, ARepetitionDiffersFarLessThanUsual) {
    const auto repeats = [](std::vector<PictureDifference> before, double mean, double tile) {
        RepetitionDetector detector;
        for (const PictureDifference& one : before) EXPECT_FALSE(detector.repeats(one));
        return detector.repeats({mean, tile});
    };
    // Whatever was before.
    EXPECT_TRUE(repeats({}, 0.03, 0.35));
    EXPECT_FALSE(repeats({}, 0.0301, 0.35));
    EXPECT_FALSE(repeats({}, 0.03, 0.351));
    // Compressed again: an eighth of the usual difference, here 4, and little by itself.
    EXPECT_FALSE(repeats({}, 0.4, 1));
    EXPECT_TRUE(repeats({{4, 9}}, 0.479, 1.5));
    EXPECT_FALSE(repeats({{4, 9}}, 0.481, 1.5));
    EXPECT_FALSE(repeats({{4, 9}}, 0.479, 1.51));
    EXPECT_TRUE(repeats({{9, 9}}, 0.5, 1.5));
    EXPECT_FALSE(repeats({{9, 9}}, 0.501, 1.5));
    // A fifth of the newest in the mean: 4, then 3.6, then 3.88.
    EXPECT_TRUE(repeats({{4, 9}, {2, 9}}, 0.43, 1));
    EXPECT_FALSE(repeats({{4, 9}, {2, 9}}, 0.434, 1));
    EXPECT_TRUE(repeats({{4, 9}, {2, 9}, {5, 9}}, 0.465, 1));
    EXPECT_FALSE(repeats({{4, 9}, {2, 9}, {5, 9}}, 0.467, 1));
    // Repetitions teach nothing.
    RepetitionDetector detector;
    EXPECT_FALSE(detector.repeats({4, 9}));
    for (int i = 0; i < 30; ++i) EXPECT_TRUE(detector.repeats({0.01, 0.1}));
    EXPECT_TRUE(detector.repeats({0.479, 1}));
    detector.reset();
    EXPECT_FALSE(detector.repeats({0.479, 1}));
}

namespace {

/// Noise with a bar of one grey level from the left; `bar` changes it.
template <class Change>
PaddingMask maskOf(const Change& change, cv::Size size = {160, 96}) {
    cv::Mat gray = random(size, 10, 60, 200);
    change(gray);
    return PaddingMask(padded(gray));
}

/// The columns of a row that count as padding.
std::string columns(const PaddingMask& mask, int y, int width = 160) {
    std::string text;
    for (int x = 0; x < width; ++x) {
        if (x > 0 && mask.contains(x, y) == mask.contains(x - 1, y)) continue;
        text += (mask.contains(x, y) ? " padding from " : " picture from ") + std::to_string(x);
    }
    return text;
}

}  // namespace

TEST(PaddingByHand, CompressionMayLeaveTwoGreyLevels) {
    for (const int base : {0, 40, 255}) {
        const auto bar = [&](int off) {
            return columns(maskOf([&](cv::Mat& gray) {
                               gray.colRange(0, 32) = base;
                               // A smear within every block.
                               for (int y = 0; y < gray.rows; y += 8)
                                   gray.row(y).colRange(0, 32) = base > 99 ? base - off : base + off;
                           }),
                           50);
        };
        EXPECT_EQ(bar(0), " padding from 0 picture from 40") << base;
        EXPECT_EQ(bar(1), " padding from 0 picture from 40") << base;
        EXPECT_EQ(bar(2), " padding from 0 picture from 40") << base;
        EXPECT_EQ(bar(3), " picture from 0") << base;
    }
}

TEST(PaddingByHand, BlocksJoinThatDifferByTwoGreyLevelsFromTheMiddleOfTheFirst) {
    // Six blocks are enough for padding, five are not.
    const auto joined = [](int low, int high, int others) {
        return maskOf([&](cv::Mat& gray) {
                   gray(cv::Rect(0, 0, 48, 8)) = others;
                   gray(cv::Rect(0, 0, 8, 4)) = low;
                   gray(cv::Rect(0, 4, 8, 4)) = high;
               })
            .contains(0, 0);
    };
    for (const int others : {28, 29, 30, 31, 32}) EXPECT_TRUE(joined(30, 30, others)) << others;
    EXPECT_FALSE(joined(30, 30, 27));
    EXPECT_FALSE(joined(30, 30, 33));
    EXPECT_TRUE(joined(30, 32, 33));
    EXPECT_TRUE(joined(30, 32, 29));
    EXPECT_FALSE(joined(30, 32, 34));
    EXPECT_FALSE(joined(30, 32, 28));
}

TEST(PaddingByHand, FewerThanSixBlocksOrOneIn200AreARoof) {
    const auto strip = [](cv::Size size, int blocks) {
        return maskOf([&](cv::Mat& gray) { gray(cv::Rect(0, 0, 8 * blocks, 8)) = 0; }, size).contains(0, 0);
    };
    EXPECT_TRUE(strip({160, 96}, 6));
    EXPECT_FALSE(strip({160, 96}, 5));
    // 40 × 36 blocks: of 1,440 seven.
    EXPECT_TRUE(strip({320, 288}, 7));
    EXPECT_FALSE(strip({320, 288}, 6));
}

TEST(PaddingByHand, EverySideHasItsBarAndAreasJoinAroundCorners) {
    // An L of two blocks on the left and one below; and a bar on the right alone.
    const PaddingMask mask = maskOf([](cv::Mat& gray) {
        gray.colRange(0, 16) = 0;
        gray.rowRange(88, 96) = 0;
        gray.colRange(136, 160) = 255;
    });
    EXPECT_EQ(columns(mask, 40), " padding from 0 picture from 24 padding from 128");
    EXPECT_EQ(columns(mask, 79), " padding from 0 picture from 24 padding from 128");
    EXPECT_EQ(columns(mask, 80), " padding from 0");
    const PaddingMask top = maskOf([](cv::Mat& gray) { gray.rowRange(0, 8) = 20; });
    EXPECT_EQ(columns(top, 15), " padding from 0");
    EXPECT_EQ(columns(top, 16), " picture from 0");
}

TEST(PaddingByHand, WhatStandsAloneInsideIsNone) {
    // A bar that padding is, and a black roof that does not touch it; in its row the left run ends before it.
    const PaddingMask mask = maskOf([](cv::Mat& gray) {
        gray.colRange(0, 16) = 0;
        gray(cv::Rect(64, 40, 16, 16)) = 0;
    });
    EXPECT_EQ(columns(mask, 48), " padding from 0 picture from 24");
    EXPECT_EQ(columns(mask, 10), " padding from 0 picture from 24");
}

TEST(PaddingByHand, WedgesAreWidenedByEightPixelsAlongTheBorderToo) {
    // A step: 40 px in the upper half, 16 px below.
    const PaddingMask mask = maskOf([](cv::Mat& gray) {
        gray(cv::Rect(0, 0, 40, 48)) = 0;
        gray(cv::Rect(0, 48, 16, 48)) = 0;
    });
    EXPECT_EQ(columns(mask, 47), " padding from 0 picture from 48");
    EXPECT_EQ(columns(mask, 55), " padding from 0 picture from 48");
    EXPECT_EQ(columns(mask, 56), " padding from 0 picture from 24");
}

TEST(PaddingByHand, ADarkLineAtTheBorderIsNone) {
    // The top bar is padding; of the noisy rows below one begins with a single black pixel, another with two.
    const PaddingMask mask = maskOf([](cv::Mat& gray) {
        gray.rowRange(0, 16) = 0;
        gray.at<std::uint8_t>(40, 0) = 0;
        gray(cv::Rect(0, 70, 2, 1)) = 0;
        gray(cv::Rect(157, 70, 3, 1)) = 0;
    });
    EXPECT_EQ(columns(mask, 40), " picture from 0");
    EXPECT_EQ(columns(mask, 70), " padding from 0 picture from 10 padding from 149");
    EXPECT_EQ(columns(mask, 62), " padding from 0 picture from 10 padding from 149");
    EXPECT_EQ(columns(mask, 61), " picture from 0");
    EXPECT_EQ(columns(mask, 78), " padding from 0 picture from 10 padding from 149");
    EXPECT_EQ(columns(mask, 79), " picture from 0");
}

TEST(PaddingByHand, PaddingLeavesAPictureWithoutBays) {
    // A tongue of n blocks goes from the upper bar of 20 × 3 blocks into the picture: rows that it crosses have gaps.
    const auto tongue = [](int length, int bars) {
        return maskOf([&](cv::Mat& gray) {
                   gray.rowRange(0, 8 * bars) = 0;
                   gray(cv::Rect(80, 8 * bars, 8, 8 * length)) = 0;
               })
            .contains(0, 0);
    };
    EXPECT_TRUE(tongue(0, 3));
    EXPECT_TRUE(tongue(1, 3)) << "one gap of 61 blocks";
    EXPECT_FALSE(tongue(2, 3)) << "two of 62";
    EXPECT_FALSE(tongue(1, 2)) << "one of 41";
    EXPECT_TRUE(tongue(2, 5)) << "two of 102";
    EXPECT_FALSE(tongue(3, 5));
    // The same for columns.
    const auto sideways = [](int length) {
        return maskOf([&](cv::Mat& gray) {
                   gray.colRange(0, 40) = 0;
                   gray(cv::Rect(40, 48, 8 * length, 8)) = 0;
               })
            .contains(0, 0);
    };
    EXPECT_TRUE(sideways(1)) << "one of 61";
    EXPECT_FALSE(sideways(2));
}

}  // namespace eyrie::slow_pictures_test
