#include "registration/search/thumbnail_search.h"

#include <gtest/gtest.h>

#include "support/textured_ground.h"

namespace eyrie::thumbnail_search_test {
namespace {

const cv::Size kWhole(256, 192);  // its thumbnail, a quarter, leaves no remainder

ImagePyramid seen(const cv::Matx33d& picture_from_ground, unsigned ground = 51) {
    ImagePyramid pyramid;
    pyramid.build(test::TexturedGround(ground, 1.5).picture(kWhole, picture_from_ground.inv(), 2, ground));
    return pyramid;
}

}  // namespace

TEST(ThumbnailSearch, findsShiftsAndTurnsWithoutAPrediction) {
    const ImagePyramid before = seen(cv::Matx33d::eye());
    const double motions[][3] = {{60, 0, 0}, {-60, 0, 0}, {0, 48, 0}, {0, -48, 0}, {32, -24, 7.5}, {-36, 20, -10}};
    for (const auto& motion : motions) {
        const cv::Matx33d truth = test::cameraMotion(kWhole, motion[0], motion[1], motion[2]);
        const auto found = searchThumbnails(before, seen(truth));
        ASSERT_TRUE(found) << motion[0] << " " << motion[1] << " " << motion[2];
        EXPECT_LT(test::gridError(*found, truth, kWhole), 2.5);
    }
}

TEST(ThumbnailSearch, aTurnAboutTheCentreLeavesTheCentre) {
    for (const double degrees : {-7.5, 5.0}) {
        const auto found = searchThumbnails(seen(cv::Matx33d::eye()), seen(test::cameraMotion(kWhole, 0, 0, degrees)));
        ASSERT_TRUE(found);
        EXPECT_LT(test::gridError(*found, test::cameraMotion(kWhole, 0, 0, degrees), kWhole), 1e-6) << degrees;
    }
}

TEST(ThumbnailSearch, twoPlacesHaveNothingInCommon) {
    EXPECT_FALSE(searchThumbnails(seen(cv::Matx33d::eye()), seen(cv::Matx33d::eye(), 97)));
    ImagePyramid flat;
    flat.build(cv::Mat(kWhole, CV_8UC1, cv::Scalar(90)));
    EXPECT_FALSE(searchThumbnails(flat, flat));
}

}  // namespace eyrie::thumbnail_search_test
