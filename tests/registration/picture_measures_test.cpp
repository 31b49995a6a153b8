#include <gtest/gtest.h>

#include "registration/pictures/image_pyramid.h"
#include "registration/pictures/noise_level.h"
#include "registration/pictures/picture_difference.h"
#include "registration/textured_ground.h"

namespace eyrie {
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

}  // namespace eyrie
