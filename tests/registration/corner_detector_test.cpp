#include "registration/corners/corner_detector.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <opencv2/imgproc.hpp>

#include "registration/pictures/noise_level.h"
#include "support/textured_ground.h"

namespace eyrie::corner_detector_test {
namespace {

PaddedPicture padded(const cv::Mat& gray) {
    PaddedPicture picture;
    picture.copyFrom(gray);
    return picture;
}

SceneScale scaleOf(double gsd) {
    SceneScale scale;
    scale.gsd_m_per_px = gsd;
    return scale;
}

std::vector<cv::Point2f> detect(const cv::Mat& gray, const CornerOptions& options = {}, double gsd = 0.3) {
    const PaddedPicture picture = padded(gray);
    CornerSurroundings surroundings;
    surroundings.noise = noiseLevel(picture);
    return CornerDetector(options, scaleOf(gsd)).detect(picture, surroundings);
}

cv::Mat ground(double contrast, double noise) {
    return test::TexturedGround(11, contrast).picture({320, 240}, cv::Matx33d::eye(), noise, 1);
}

}  // namespace

TEST(CornerDetector, findsSquaresAtTheirSubPixelCorners) {
    // Bright squares drawn 16 times too large and averaged down; each must have a corner near each of its four.
    constexpr int kOver = 16;
    cv::Mat large(120 * kOver, 160 * kOver, CV_8UC1, cv::Scalar(60));
    std::vector<cv::Point2d> truth;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 5; ++column) {
            const cv::Point from((15 + 28 * column) * kOver + 5 * row + column, (12 + 26 * row) * kOver + 3 * column);
            const cv::Size size(11 * kOver + 7, 9 * kOver + 3);
            cv::rectangle(large, cv::Rect(from, size), cv::Scalar(180), cv::FILLED);
            for (const int x : {from.x, from.x + size.width}) {
                // Edge coordinate e of the large picture is pixel e / 16 − ½ of the small one.
                for (const int y : {from.y, from.y + size.height})
                    truth.emplace_back(double(x) / kOver - 0.5, double(y) / kOver - 0.5);
            }
        }
    }
    cv::Mat gray;
    cv::resize(large, gray, {160, 120}, 0, 0, cv::INTER_AREA);
    const auto corners = detect(gray);
    EXPECT_EQ(corners.size(), truth.size());
    for (const cv::Point2d& expected : truth) {
        double nearest = 1e9;
        for (const cv::Point2f& corner : corners) {
            nearest = std::min(nearest, std::hypot(double(corner.x) - expected.x, double(corner.y) - expected.y));
        }
        EXPECT_LT(nearest, 0.25);
    }
}

TEST(CornerDetector, flatAndConstantPicturesHaveNone) {
    EXPECT_TRUE(detect(cv::Mat(100, 100, CV_8UC1, cv::Scalar(0))).empty());
    EXPECT_TRUE(detect(cv::Mat(100, 100, CV_8UC1, cv::Scalar(255))).empty());
}

TEST(CornerDetector, thresholdFollowsContrastAndNoise) {
    // The same scene at a third of the contrast and noise, as at dusk, must carry about as many corners.
    const auto bright = detect(ground(1, 3)).size();
    const auto dusk = detect(ground(1.0 / 3, 1)).size();
    EXPECT_GT(bright, 1500U);
    EXPECT_NEAR(double(dusk), double(bright), 0.15 * double(bright));
}

TEST(CornerDetector, pureNoiseCarriesFewCorners) {
    EXPECT_LT(detect(ground(0, 6)).size(), detect(ground(1, 6)).size() / 5);
}

TEST(CornerDetector, keepsItsDistances) {
    CornerOptions options;
    const PaddedPicture picture = padded(ground(1, 2));
    CornerSurroundings surroundings;
    surroundings.noise = 2;
    const CornerDetector detector(options, scaleOf(0.1));
    EXPECT_NEAR(detector.spacing(), 6, 1e-9);
    const auto first = detector.detect(picture, surroundings);
    surroundings.living = first;
    const auto second = detector.detect(picture, surroundings);
    EXPECT_LT(second.size(), first.size());
    for (const auto& corner : second) {
        for (const auto& old : first) EXPECT_GT(cv::norm(corner - old), 2.5);  // 0.8 spacing, less refinement
    }
    // Pixels do not get finer than the floor.
    EXPECT_EQ(CornerDetector(options, scaleOf(5)).spacing(), options.min_corner_distance);
}

TEST(CornerDetector, capIsKeptAndSharedOut) {
    CornerOptions options;
    options.max_corners = 400;
    const auto corners = detect(ground(1, 2), options);
    EXPECT_LE(corners.size(), 400U);
    EXPECT_GT(corners.size(), 250U);
    int quadrant[4] = {};
    for (const auto& corner : corners) ++quadrant[(corner.x > 160 ? 1 : 0) + (corner.y > 120 ? 2 : 0)];
    for (const int count : quadrant) EXPECT_NEAR(count, double(corners.size()) / 4, double(corners.size()) / 12);
}

TEST(CornerDetector, moversKeepTheirDensityUnderTheCap) {
    CornerOptions options;
    options.max_corners = 300;
    const PaddedPicture picture = padded(ground(1, 2));
    CornerSurroundings surroundings;
    surroundings.noise = 2;
    const auto countNear = [](const std::vector<cv::Point2f>& corners) {
        return std::count_if(corners.begin(), corners.end(),
                             [](const cv::Point2f& p) { return cv::norm(p - cv::Point2f(100, 100)) < 8; });
    };
    const CornerDetector detector(options, scaleOf(0.3));
    const auto without = countNear(detector.detect(picture, surroundings));
    surroundings.movers = {{96, 100}, {100, 100}, {104, 100}};
    const auto with = countNear(detector.detect(picture, surroundings));
    EXPECT_GE(with, 3 * std::max<long>(1, without));
    options.favour_movers = false;
    const CornerDetector even(options, scaleOf(0.3));
    const auto beside_movers = even.detect(picture, surroundings);
    surroundings.movers.clear();
    EXPECT_EQ(even.detect(picture, surroundings), beside_movers);
    EXPECT_GT(beside_movers.size(), detector.detect(picture, surroundings).size()) << "no room is kept for movers";
}

TEST(CornerDetector, placesNothingAtPadding) {
    // A picture turned inside its frame: black wedges with hard, corner-rich borders.
    cv::Mat turned;
    const cv::Mat rotation = cv::getRotationMatrix2D({160, 120}, 9, 0.9);
    cv::warpAffine(ground(1, 2), turned, rotation, {320, 240}, cv::INTER_NEAREST, cv::BORDER_CONSTANT, cv::Scalar(0));
    cv::Mat inside;
    cv::warpAffine(cv::Mat(240, 320, CV_8UC1, cv::Scalar(255)), inside, rotation, {320, 240}, cv::INTER_NEAREST);
    cv::erode(inside, inside, cv::getStructuringElement(cv::MORPH_RECT, {7, 7}));
    const auto corners = detect(turned);
    EXPECT_GT(corners.size(), 500U);
    for (const auto& corner : corners) {
        EXPECT_NE(inside.at<std::uint8_t>(cvRound(corner.y), cvRound(corner.x)), 0) << corner;
    }
}

TEST(CornerDetector, clippedShadowsAreNotPadding) {
    // Dusk: everything under a level is black, in many patches that reach the border. Corners beside them stay.
    cv::Mat dusk = ground(1, 0) - 118;
    EXPECT_GT(detect(dusk).size(), 300U);
}

TEST(CornerDetector, doesNotDependOnThreads) {
    const cv::Mat gray = ground(1, 2);
    std::vector<cv::Point2f> one;
    {
        const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
        one = detect(gray);
    }
    EXPECT_EQ(one, detect(gray));
}

TEST(CornerDetector, thoseFoundAtOnceKeepTheirDistance) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const double gsd = seed % 2 == 0 ? 0.1 : 0.03;
        const double apart = 0.8 * CornerDetector({}, scaleOf(gsd)).spacing();
        const cv::Mat gray = test::TexturedGround(seed).picture({160, 120}, cv::Matx33d::eye(), 2, seed);
        const auto corners = detect(gray, {}, gsd);
        EXPECT_GT(corners.size(), 10U);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) EXPECT_GT(cv::norm(corners[i] - corners[j]), apart - 2.5);
        }
    }
}

TEST(CornerDetector, theCapIsUsedUp) {
    // Without movers all but 15 % of it, which are kept for them.
    for (const int most : {200, 333, 400}) {
        CornerOptions options;
        options.max_corners = most;
        EXPECT_EQ(detect(ground(1, 2), options).size(), std::size_t(0.85 * most));
        options.favour_movers = false;
        EXPECT_EQ(detect(ground(1, 2), options).size(), std::size_t(most));
    }
    CornerOptions options;
    options.max_corners = 400;
    const PaddedPicture picture = padded(ground(1, 2));
    CornerSurroundings surroundings;
    surroundings.noise = 2;
    const CornerDetector detector(options, scaleOf(0.3));
    const auto first = detector.detect(picture, surroundings);
    // A vehicle's worth fewer is found again.
    surroundings.living.assign(first.begin() + 40, first.end());
    EXPECT_EQ(detector.detect(picture, surroundings).size(), 40U);
    surroundings.living = first;
    EXPECT_TRUE(detector.detect(picture, surroundings).empty());
}

TEST(CornerDetector, aLargePictureMayHaveMoreCornersUpToTwiceAsMany) {
    CornerOptions options;
    options.max_corners = 400;
    options.favour_movers = false;
    for (const auto& [size, most] : {std::pair(cv::Size(1280, 720), 400), std::pair(cv::Size(1440, 900), 562),
                                     std::pair(cv::Size(1920, 1080), 800), std::pair(cv::Size(2560, 1440), 800)}) {
        cv::Mat gray;
        cv::repeat(ground(1, 2), size.height / 240 + 1, size.width / 320 + 1, gray);
        EXPECT_NEAR(static_cast<double>(detect(gray(cv::Rect({}, size)), options).size()), most, 1) << size;
    }
}

TEST(CornerDetector, underTheCapTheStrongestOfAPartStay) {
    // Half the picture has a third of the contrast; in each half those kept are stronger than most.
    CornerOptions options;
    options.favour_movers = false;
    const auto all = detect(ground(1, 2), options);
    options.max_corners = int(all.size()) / 4;
    const auto kept = detect(ground(1, 2), options);
    const PaddedPicture picture = padded(ground(1, 2));
    const auto contrast = [&](const std::vector<cv::Point2f>& corners) {
        double sum = 0;
        for (const cv::Point2f& p : corners) {
            const int x = cvRound(p.x), y = cvRound(p.y);
            sum += std::abs(picture.row(y)[x + 2] - picture.row(y)[x - 2]) +
                   std::abs(picture.row(y + 2)[x] - picture.row(y - 2)[x]);
        }
        return sum / double(corners.size());
    };
    EXPECT_GT(contrast(kept), 1.15 * contrast(all));
}

}  // namespace eyrie::corner_detector_test
