#include <gtest/gtest.h>

#include <random>

#include "registration/pictures/image_pyramid.h"
#include "registration/pictures/noise_level.h"
#include "registration/pictures/padding_mask.h"
#include "registration/pictures/picture_difference.h"
#include "support/textured_ground.h"

namespace eyrie::picture_measures_test {
namespace {

const cv::Size kSize(200, 150);

PaddedPicture padded(const cv::Mat& gray) {
    PaddedPicture picture;
    picture.copyFrom(gray);
    return picture;
}

PaddedPicture ground(double noise, unsigned seed, double shift = 0) {
    return padded(test::TexturedGround(31).picture(kSize, {1, 0, shift, 0, 1, 0, 0, 0, 1}, noise, seed));
}

}  // namespace

TEST(NoiseLevel, followsTheNoiseMoreThanTheTexture) {
    EXPECT_NEAR(noiseLevel(padded(test::TexturedGround(30, 0).picture(kSize, cv::Matx33d::eye(), 4, 1))), 4, 0.3);
    EXPECT_NEAR(noiseLevel(ground(6, 1)), 6, 1.5);
    EXPECT_EQ(noiseLevel(padded(cv::Mat(50, 50, CV_8UC1, cv::Scalar(7)))), kQuietest);
    EXPECT_EQ(noiseLevel(padded(cv::Mat(1, 1, CV_8UC1, cv::Scalar(7)))), kQuietest);
}

TEST(PictureDifference, isTheMeanOverThePictureAndItsWorstTile) {
    cv::Mat a(40, 50, CV_8UC1, cv::Scalar(10));
    cv::Mat b = a.clone();
    b(cv::Rect(16, 16, 16, 16)) = 14;
    const PictureDifference d = difference(padded(a), padded(b));
    EXPECT_DOUBLE_EQ(d.mean, 4.0 * 256 / 2000);
    EXPECT_DOUBLE_EQ(d.worst_tile, 4);
}

TEST(RepetitionDetector, tellsRepeatedPicturesFromAStandingCamera) {
    RepetitionDetector detector;
    const PaddedPicture first = ground(1.5, 1);
    EXPECT_FALSE(detector.repeats(difference(first, ground(1.5, 2))));  // stands still, new noise
    EXPECT_FALSE(detector.repeats(difference(first, ground(1.5, 3, 1.2))));
    EXPECT_TRUE(detector.repeats(difference(first, first)));
    // Compressed once more: a few pixels differ by one.
    cv::Mat again(kSize, CV_8UC1);
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x)
            again.at<std::uint8_t>(y, x) = std::uint8_t(first.row(y)[x] + ((x * 7 + y * 13) % 9 == 0));
    }
    EXPECT_TRUE(detector.repeats(difference(first, padded(again))));
}

TEST(RepetitionDetector, aVehicleThatMovesInAStillPictureIsNoRepetition) {
    RepetitionDetector detector;
    cv::Mat before = test::TexturedGround(31).picture({640, 480}, cv::Matx33d::eye(), 0, 1);
    cv::Mat after = before.clone();
    before(cv::Rect(300, 200, 10, 5)) = 220;
    after(cv::Rect(301, 200, 10, 5)) = 220;
    EXPECT_FALSE(detector.repeats(difference(padded(before), padded(after))));
}

TEST(PaddingMask, ReachesEightPixelsBeyondTheBarsOfEachSide) {
    for (int side = 0; side < 4; ++side) {
        cv::Mat gray = test::TexturedGround(31).picture(kSize, cv::Matx33d::eye(), 3, 1);
        const cv::Rect bars[] = {{0, 0, 24, 150}, {160, 0, 40, 150}, {0, 0, 200, 16}, {0, 118, 200, 32}};
        gray(bars[side]) = 0;
        const PaddingMask mask(padded(gray));
        const cv::Rect within = bars[side] + cv::Size(16, 16) - cv::Point(8, 8);
        int wrong = 0;
        for (int y = 0; y < kSize.height; ++y) {
            for (int x = 0; x < kSize.width; ++x) wrong += mask.contains(x, y) != within.contains({x, y});
        }
        EXPECT_EQ(wrong, 0) << side;
    }
    const PaddingMask none(padded(test::TexturedGround(31).picture(kSize, cv::Matx33d::eye(), 3, 1)));
    EXPECT_FALSE(none.contains(0, 0));
    cv::Mat gray = test::TexturedGround(31).picture(kSize, cv::Matx33d::eye(), 3, 1);
    gray(cv::Rect(80, 60, 40, 40)) = 0;
    EXPECT_FALSE(PaddingMask(padded(gray)).contains(100, 80)) << "a black roof in the middle";
}

TEST(ImagePyramid, halvesToASensibleSizeAndKeepsPlaces) {
    ImagePyramid pyramid;
    pyramid.build(test::TexturedGround(32).picture({320, 200}, cv::Matx33d::eye(), 0, 1));
    EXPECT_EQ(pyramid.levels(), 4);
    EXPECT_EQ(pyramid.level(3).width(), 40);
    const auto* a = pyramid.level(0).row(20) + 30;
    const auto* b = pyramid.level(0).row(21) + 30;
    EXPECT_EQ(int(pyramid.level(1).row(10)[15]), (a[0] + a[1] + b[0] + b[1] + 2) / 4);
    const cv::Point2f p = ImagePyramid::fromLevel(ImagePyramid::toLevel({17.3F, 5.1F}, 3), 3);
    EXPECT_NEAR(p.x, 17.3, 1e-4);
    EXPECT_NEAR(p.y, 5.1, 1e-4);
    pyramid.build(cv::Mat(1, 1, CV_8UC1, cv::Scalar(3)));
    EXPECT_EQ(pyramid.levels(), 1);
}

TEST(ImagePyramid, smoothsWithTheBinomialMask) {
    cv::Mat spot(9, 9, CV_8UC1, cv::Scalar(0));
    spot.at<std::uint8_t>(4, 4) = 160;
    spot.at<std::uint8_t>(0, 0) = 160;
    ImagePyramid pyramid;
    pyramid.build(spot);
    const auto at = [&](int x, int y) { return int(pyramid.smooth().row(y)[x]); };
    EXPECT_EQ(at(4, 4), 40);
    EXPECT_EQ(at(5, 4), 20);
    EXPECT_EQ(at(5, 5), 10);
    EXPECT_EQ(at(0, 0), 90);  // the border repeats outwards: 9 of 16
    EXPECT_EQ(at(6, 4), 0);
}

TEST(NoiseLevel, slopesOfLightAreNoNoise) {
    // The mask sees neither slopes nor what changes along one axis only.
    cv::Mat slope(90, 100, CV_8UC1);
    for (int y = 0; y < slope.rows; ++y) {
        for (int x = 0; x < slope.cols; ++x) slope.at<std::uint8_t>(y, x) = std::uint8_t(5 + x + y);
    }
    EXPECT_EQ(noiseLevel(padded(slope)), kQuietest);
    cv::Mat stripes(90, 100, CV_8UC1);
    for (int x = 0; x < stripes.cols; ++x) stripes.col(x) = x * 37 % 200;
    EXPECT_EQ(noiseLevel(padded(stripes)), kQuietest);
    cv::Mat lines(100, 90, CV_8UC1);
    for (int y = 0; y < lines.rows; ++y) lines.row(y) = y * 37 % 200;
    EXPECT_EQ(noiseLevel(padded(lines)), kQuietest);
}

TEST(NoiseLevel, isTheNoiseInLargePicturesToo) {
    for (const cv::Size size : {cv::Size(330, 200), cv::Size(320, 640), cv::Size(1000, 500)}) {
        cv::Mat gray(size, CV_8UC1);
        std::mt19937 random(3);
        std::normal_distribution<double> normal(100, 5);
        for (std::uint8_t& value : cv::Mat_<std::uint8_t>(gray))
            value = cv::saturate_cast<std::uint8_t>(normal(random));
        EXPECT_NEAR(noiseLevel(padded(gray)), 5, 0.15) << size;
    }
}

TEST(PictureDifference, sliversAtTheBorderHaveNoWorstTile) {
    // 35 columns: two tiles and three columns, of which 48 pixels are less than a quarter of a tile.
    cv::Mat a(32, 35, CV_8UC1, cv::Scalar(10));
    cv::Mat b = a.clone();
    b.colRange(32, 35) = 0;
    EXPECT_EQ(difference(padded(a), padded(b)).worst_tile, 0);
    EXPECT_DOUBLE_EQ(difference(padded(a), padded(b)).mean, 10.0 * 3 / 35);
    cv::Mat wider(32, 36, CV_8UC1, cv::Scalar(10));
    b = wider.clone();
    b(cv::Rect(32, 16, 4, 16)) = 16;
    EXPECT_DOUBLE_EQ(difference(padded(wider), padded(b)).worst_tile, 6);
}

TEST(ImagePyramid, endsWhereTheShorterSideWouldBeTooShort) {
    const auto levels = [](cv::Size size) {
        ImagePyramid pyramid;
        pyramid.build(cv::Mat(size, CV_8UC1, cv::Scalar(3)));
        return pyramid.levels();
    };
    EXPECT_EQ(levels({320, 47}), 1);
    EXPECT_EQ(levels({320, 48}), 2);
    EXPECT_EQ(levels({48, 320}), 2);
    EXPECT_EQ(levels({4000, 4000}), ImagePyramid::kMaxLevels);
}

}  // namespace eyrie::picture_measures_test
