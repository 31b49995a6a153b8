#include "imaging/following/box_patch.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "annotation/scenes.h"

/// How alike the insides of boxes look.
namespace eyrie::box_patch_test {
namespace {

const OrientedBox kLorry{{60, 40}, 48, 12, 0};

cv::Mat texture() {
    return test::groundTexture({120, 80}, 4, 1.5, 60, 180);
}

/// Another thing lies in front of a part of the picture.
cv::Mat hidden(cv::Mat picture, const cv::Rect& part) {
    test::groundTexture(picture.size(), 9, 1.5, 60, 180)(part).copyTo(picture(part));
    return picture;
}

BoxPatch patchOf(const cv::Mat& picture, const OrientedBox& box) {
    return {picture, box, BoxPatch::samplesFor(box)};
}

/// The grey between pixels; beyond the border the border's goes on.
double greyAt(const cv::Mat& picture, cv::Point2d at) {
    const auto grey = [&](double x, double y) {
        return picture.at<unsigned char>(std::clamp(static_cast<int>(y), 0, picture.rows - 1),
                                         std::clamp(static_cast<int>(x), 0, picture.cols - 1));
    };
    const double x = std::floor(at.x), y = std::floor(at.y);
    return (grey(x, y) * (x + 1 - at.x) + grey(x + 1, y) * (at.x - x)) * (y + 1 - at.y) +
           (grey(x, y + 1) * (x + 1 - at.x) + grey(x + 1, y + 1) * (at.x - x)) * (at.y - y);
}

/// What is in a box and 6 % of it beyond each side, sample by sample.
std::vector<double> samplesOf(const cv::Mat& picture, const OrientedBox& box, cv::Size samples) {
    std::vector<double> values;
    for (int y = 0; y < samples.height; ++y) {
        for (int x = 0; x < samples.width; ++x) {
            const double along = ((x + 0.5) / samples.width - 0.5) * 1.12 * box.length;
            const double across = ((y + 0.5) / samples.height - 0.5) * 1.12 * box.width;
            values.push_back(greyAt(picture, box.toImage({along, across})));
        }
    }
    return values;
}

/// Pearson's correlation.
double correlationOf(const std::vector<double>& a, const std::vector<double>& b) {
    const double n = static_cast<double>(a.size());
    const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
    const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - mean_a) * (b[i] - mean_b);
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
    }
    return ab / std::sqrt(aa * bb);
}

/// A patch with a sample for each pixel of a small picture.
BoxPatch patchOfAll(const cv::Mat& picture) {
    const cv::Point2d middle((picture.cols - 1) / 2.0, (picture.rows - 1) / 2.0);
    return {picture, {middle, picture.cols / 1.12, picture.rows / 1.12, 0}, picture.size()};
}

/// Stripes along or, where `other`, along for a share of the rows of every eight and across for the rest.
cv::Mat striped(cv::Size size, const std::function<int(int x, int y)>& contrast,
                const std::function<bool(int x, int y)>& other = {}) {
    cv::Mat picture(size, CV_8UC1);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const bool bright = other && other(x, y) ? x % 2 == 0 : y % 2 == 0;
            picture.at<unsigned char>(y, x) = static_cast<unsigned char>(128 + (bright ? 1 : -1) * contrast(x, y));
        }
    }
    return picture;
}

}  // namespace

TEST(BoxPatch, HasASampleForEveryPixelWithinLimits) {
    EXPECT_EQ(BoxPatch::samplesFor(kLorry), cv::Size(48, 12));
    EXPECT_EQ(BoxPatch::samplesFor({{0, 0}, 300, 2, 0}), cv::Size(48, 6));
}

TEST(BoxPatch, HasSixToFortyEightSamplesASide) {
    const auto samples = [](double length, double width) { return BoxPatch::samplesFor({{0, 0}, length, width, 0}); };
    EXPECT_EQ(samples(10.4, 10.6), cv::Size(10, 11));
    EXPECT_EQ(samples(6.6, 5.4), cv::Size(7, 6));
    EXPECT_EQ(samples(47.4, 60), cv::Size(47, 48));
    EXPECT_EQ(samples(49, 7), cv::Size(48, 7));
}

TEST(BoxPatch, IsWhatThePictureShowsInTheBoxAndALittleBeyond) {
    const cv::Size samples(20, 12);
    const OrientedBox here{{60.3, 40.6}, 26, 13, 0.5};
    const std::vector<double> seen = samplesOf(texture(), here, samples);
    const BoxPatch patch(texture(), here, samples);
    EXPECT_NEAR(correlationOf(seen, seen), 1, 1e-9);
    for (const OrientedBox& there : {OrientedBox{{61, 41}, 26, 13, 0.5},
                                     {{60.3, 40.6}, 29, 13, 0.5},
                                     {{60.3, 40.6}, 26, 15, 0.4},
                                     {{50, 30}, 22, 11, -2},
                                     {{2, 3}, 26, 13, 0.2},
                                     {{117.5, 30}, 26, 13, 0.1},
                                     {{60, 78}, 26, 13, 3},
                                     {{119, 79}, 26, 13, 0.7}}) {
        const double expected = correlationOf(seen, samplesOf(texture(), there, samples));
        EXPECT_NEAR(BoxPatch(texture(), there, samples).correlation(patch), expected, 2e-3) << there.centre;
    }
}

TEST(BoxPatch, IsWhatThePictureShowsWhereverItsBorderLies) {
    cv::RNG dice(6);
    const cv::Mat picture = test::groundTexture({60, 40}, 4, 0.8, 10, 245);
    for (int round = 0; round < 400; ++round) {
        const cv::Size samples(dice.uniform(6, 20), dice.uniform(6, 20));
        const OrientedBox here{{30, 20}, dice.uniform(8.0, 30.0), dice.uniform(6.0, 20.0), dice.uniform(-3.0, 3.0)};
        OrientedBox there = here;
        there.centre = {dice.uniform(-8.0, 68.0), dice.uniform(-6.0, 46.0)};
        if (round % 2 == 0) there.heading = dice.uniform(0, 4) * CV_PI / 2;
        const double expected = correlationOf(samplesOf(picture, here, samples), samplesOf(picture, there, samples));
        if (std::isnan(expected)) continue;  // all of one row or column, all the same
        EXPECT_NEAR(BoxPatch(picture, here, samples).correlation(BoxPatch(picture, there, samples)), expected, 3e-3)
            << there.centre << there.heading;
    }
}

TEST(BoxPatch, ShowsTheLastRowAndColumnOfThePicture) {
    // A bright border one pixel wide: it is all that is seen beyond it.
    cv::Mat picture(40, 60, CV_8UC1, cv::Scalar(0));
    cv::rectangle(picture, {0, 0, 60, 40}, cv::Scalar(200), 1);
    const cv::Size samples(12, 12);
    const double spacing = 1 / 1.12;
    for (const cv::Point2d centre : {cv::Point2d(59.5, 20), {-0.5, 20}, {30, 39.5}, {30, -0.5}}) {
        const OrientedBox box{centre, 12 * spacing, 12 * spacing, 0};
        cv::Mat half(12, 12, CV_8UC1, cv::Scalar(0));
        const bool beside = centre.y == 20;
        half(beside ? cv::Rect(centre.x < 0 ? 0 : 6, 0, 6, 12) : cv::Rect(0, centre.y < 0 ? 0 : 6, 12, 6)).setTo(200);
        // The middle between two samples is half a pixel beyond the border.
        cv::Mat expected = half.clone();
        if (beside)
            expected.col(centre.x < 0 ? 6 : 5).setTo(200);
        else
            expected.row(centre.y < 0 ? 6 : 5).setTo(200);
        EXPECT_NEAR(BoxPatch(picture, box, samples).correlation(patchOfAll(expected)), 1, 2e-3) << centre;
    }
}

TEST(BoxPatch, OfAnotherSizeIsNotAlike) {
    const BoxPatch patch(texture(), kLorry, {48, 12});
    const BoxPatch small(texture(), kLorry, {24, 12});
    EXPECT_EQ(patch.correlation(small), 0);
    EXPECT_EQ(patch.seenOf(small), 0);
    EXPECT_EQ(BoxPatch().seenOf(BoxPatch()), 0);
    EXPECT_TRUE(BoxPatch().empty());
    BoxPatch learns = patch;
    learns.learn(small, 1);
    EXPECT_NEAR(learns.correlation(patch), 1, 1e-5);
}

TEST(BoxPatch, DoesNotKnowBrightnessAndContrast) {
    const BoxPatch patch = patchOf(texture(), kLorry);
    cv::Mat other;
    texture().convertTo(other, -1, 0.5, 70);
    EXPECT_NEAR(patchOf(other, kLorry).correlation(patch), 1, 0.01);
    texture().convertTo(other, -1, -1, 240);
    EXPECT_NEAR(patchOf(other, kLorry).correlation(patch), -1, 0.01);
    EXPECT_EQ(patchOf(cv::Mat(80, 120, CV_8UC1, cv::Scalar(90)), kLorry).correlation(patch), 0);
    EXPECT_LT(patchOf(hidden(texture(), {0, 0, 120, 80}), kLorry).correlation(patch), 0.5);
}

TEST(BoxPatch, TurnsWithTheBox) {
    cv::Mat turned;
    cv::rotate(texture(), turned, cv::ROTATE_90_CLOCKWISE);
    const OrientedBox there{{79 - kLorry.centre.y, kLorry.centre.x}, 48, 12, CV_PI / 2};
    EXPECT_NEAR(patchOf(turned, there).correlation(patchOf(texture(), kLorry)), 1, 1e-3);
}

TEST(BoxPatch, IsSeenWhereNothingLiesInFront) {
    const BoxPatch whole = patchOf(texture(), kLorry);
    EXPECT_EQ(whole.seenOf(whole), 1);
    EXPECT_LT(patchOf(hidden(texture(), {0, 0, 120, 80}), kLorry).seenOf(whole), 0.15) << "by chance";
    EXPECT_NEAR(patchOf(hidden(texture(), {0, 0, 60, 80}), kLorry).seenOf(whole), 0.5, 0.1);
    EXPECT_NEAR(patchOf(hidden(texture(), {0, 0, 42, 80}), kLorry).seenOf(whole), 0.75, 0.1);
}

TEST(BoxPatch, IsSeenAsMuchWhetherItsLengthOrItsWidthIsLonger) {
    // Two parts across, of which something covers the most of one.
    const cv::Rect part(0, 0, 120, 39);
    cv::Mat turned;
    cv::rotate(texture(), turned, cv::ROTATE_90_CLOCKWISE);
    cv::Mat turned_hidden;
    cv::rotate(hidden(texture(), part), turned_hidden, cv::ROTATE_90_CLOCKWISE);
    const OrientedBox tall{{79 - kLorry.centre.y, kLorry.centre.x}, 12, 48, 0};
    const double across = patchOf(hidden(texture(), part), kLorry).seenOf(patchOf(texture(), kLorry));
    EXPECT_NEAR(across, 0.5, 0.1);
    EXPECT_NEAR(patchOf(turned_hidden, tall).seenOf(patchOf(turned, tall)), across, 1e-9);
}

TEST(BoxPatch, IsSeenByPartsOfAboutEightSamples) {
    const auto even = [](int, int) { return 50; };
    const auto seen = [&](cv::Size size, const cv::Rect& covered) {
        const cv::Mat whole = striped(size, even);
        const auto isCovered = [&](int x, int y) { return covered.contains({x, y}); };
        return patchOfAll(striped(size, even, isCovered)).seenOf(patchOfAll(whole));
    };
    EXPECT_NEAR(seen({24, 16}, {16, 8, 8, 8}), 5 / 6.0, 1e-9) << "one of three by two";
    EXPECT_NEAR(seen({24, 16}, {0, 0, 8, 16}), 4 / 6.0, 1e-9);
    EXPECT_NEAR(seen({16, 24}, {0, 16, 16, 8}), 4 / 6.0, 1e-9);
    EXPECT_NEAR(seen({24, 16}, {8, 8, 16, 8}), 4 / 6.0, 1e-9);
    EXPECT_NEAR(seen({48, 32}, {40, 0, 8, 8}), 23 / 24.0, 1e-9);
    EXPECT_NEAR(seen({23, 16}, {12, 0, 11, 8}), 3 / 4.0, 1e-9) << "23 samples are no three eights";
    EXPECT_NEAR(seen({8, 8}, {0, 0, 4, 4}), 3 / 4.0, 1e-9) << "two by two at least";
}

TEST(BoxPatch, APartIsSeenWhoseCorrelationIsMoreThanSevenTenths) {
    const auto even = [](int, int) { return 50; };
    const cv::Size size(20, 20);  // two by two parts of ten
    const BoxPatch whole = patchOfAll(striped(size, even));
    // Each pixel that is wrong takes a fiftieth; half of what the other stripes show is right.
    const auto seen = [&](int rows) {
        const auto isCovered = [&](int x, int y) { return x < 10 && y < rows; };
        return patchOfAll(striped(size, even, isCovered)).seenOf(whole);
    };
    EXPECT_EQ(seen(2), 1) << "correlation 0.8";
    EXPECT_EQ(seen(4), 0.75) << "0.6";
    // Contrast makes no difference.
    const auto weak = [](int x, int y) { return x < 10 && y < 10 ? 25 : 50; };
    EXPECT_EQ(patchOfAll(striped(size, weak)).seenOf(whole), 1);
}

TEST(BoxPatch, PartsThatShowLittleDoNotCount) {
    const cv::Size size(24, 16);
    // One of six parts has less contrast; the other one is hidden there.
    const auto seen = [&](int contrast, int of_others = 100) {
        const auto inFirst = [](int x, int y) { return x < 8 && y < 8; };
        const auto weak = [&](int x, int y) { return inFirst(x, y) ? contrast : of_others; };
        return patchOfAll(striped(size, weak, inFirst)).seenOf(patchOfAll(striped(size, weak)));
    };
    // Of the variance a part has c² / (5 + c²), against the mean 6 c² / (5 + c²).
    EXPECT_NEAR(seen(40), 5 / 6.0, 1e-9) << "0.19";
    EXPECT_EQ(seen(33), 1) << "0.13";
    EXPECT_NEAR(seen(100), 5 / 6.0, 1e-9);
    EXPECT_EQ(seen(100, 0), 0) << "all that shows anything is hidden";
    EXPECT_EQ(seen(0, 0), 0) << "nothing is shown at all";
}

TEST(BoxPatch, IsSeenByTheShareOfItsPartsThatCorrelateWhateverTheirSize) {
    cv::RNG dice(4);
    int in_part = 0;
    for (int round = 0; round < 200; ++round) {
        const cv::Size size(dice.uniform(6, 49), dice.uniform(6, 49));
        // Texture in some places, little in others; the other picture is the same but for noise of its own strength.
        cv::Mat whole(size, CV_64FC1), other(size, CV_64FC1);
        dice.fill(whole, cv::RNG::NORMAL, 0, 1);
        dice.fill(other, cv::RNG::NORMAL, 0, 1);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                whole.at<double>(y, x) *= 8 + 22.0 * (x + y) / (size.width + size.height);
                other.at<double>(y, x) = whole.at<double>(y, x) + other.at<double>(y, x) * (12 + 24.0 * x / size.width);
            }
        }
        cv::Mat whole_bytes, other_bytes;
        whole.convertTo(whole_bytes, CV_8U, 1, 128);
        other.convertTo(other_bytes, CV_8U, 1, 128);
        const int columns = std::max(2, size.width / 8), rows = std::max(2, size.height / 8);
        const auto partOf = [&](const cv::Mat& picture, int column, int row) {
            std::vector<double> values;
            for (int y = size.height * row / rows; y < size.height * (row + 1) / rows; ++y)
                for (int x = size.width * column / columns; x < size.width * (column + 1) / columns; ++x)
                    values.push_back(picture.at<unsigned char>(y, x));
            return values;
        };
        const auto scatterOf = [](const std::vector<double>& values) {
            const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
            return std::accumulate(values.begin(), values.end(), 0.0,
                                   [&](double sum, double value) { return sum + (value - mean) * (value - mean); });
        };
        const double all = scatterOf({whole_bytes.begin<unsigned char>(), whole_bytes.end<unsigned char>()});
        int parts = 0, alike = 0;
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; ++column) {
                const std::vector<double> mine = partOf(other_bytes, column, row),
                                          its = partOf(whole_bytes, column, row);
                if (scatterOf(its) * columns * rows < 0.15 * all) continue;
                ++parts;
                alike += correlationOf(mine, its) > 0.7;
            }
        }
        const double expected = parts == 0 ? 0 : static_cast<double>(alike) / parts;
        EXPECT_NEAR(patchOfAll(other_bytes).seenOf(patchOfAll(whole_bytes)), expected, 1e-9) << size;
        in_part += alike > 0 && alike < parts;
    }
    EXPECT_GE(in_part, 100);
}

TEST(BoxPatch, LearnsByShares) {
    BoxPatch patch = patchOf(texture(), kLorry);
    const BoxPatch start = patch;
    const BoxPatch other = patchOf(hidden(texture(), {0, 0, 120, 80}), kLorry);
    patch.learn(other, 0);
    EXPECT_NEAR(patch.correlation(start), 1, 1e-5);
    patch.learn(other, 0.25);
    EXPECT_GT(patch.correlation(start), patch.correlation(other));
    EXPECT_GT(patch.correlation(other), start.correlation(other));
    EXPECT_NEAR(patch.correlation(patch), 1, 1e-5) << "of length one again";
    patch.learn(other, 1);
    EXPECT_NEAR(patch.correlation(other), 1, 1e-5);
}

}  // namespace eyrie::box_patch_test
