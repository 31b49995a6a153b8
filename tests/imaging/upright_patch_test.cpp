#include "imaging/upright_patch.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/geometry/angle.h"

namespace eyrie::upright_patch_test {
namespace {

cv::Mat scene(int columns = 120, int rows = 90) {
    cv::Mat gray(rows, columns, CV_8UC1);
    cv::RNG random(4);
    random.fill(gray, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(gray, gray, {0, 0}, 2);
    return gray;
}

TEST(UprightPatch, OfAnAreaThatPointsUpIsTheImagePart) {
    const cv::Mat gray = scene();
    const OrientedBox area{{50, 40}, 21, 11, -kPi / 2};
    const UprightPatch patch = cutUpright(gray, area);
    ASSERT_EQ(patch.image.size(), cv::Size(11, 21));
    EXPECT_EQ(cv::norm(patch.image, gray(cv::Rect(45, 30, 11, 21)), cv::NORM_INF), 0);
    EXPECT_EQ(cv::countNonZero(patch.inside), 11 * 21);
}

TEST(UprightPatch, HasTheHeadingUpAndTheRightSideRight) {
    cv::Mat gray(90, 120, CV_8UC1, cv::Scalar(0));
    const double heading = 0.7;
    const OrientedBox area{{60, 45}, 41, 21, heading};
    const cv::Point2d ahead = area.toImage({12, 0});
    const cv::Point2d right = area.toImage({0, 6});
    cv::circle(gray, ahead, 2, 255, cv::FILLED);
    cv::circle(gray, right, 2, 120, cv::FILLED);
    const UprightPatch patch = cutUpright(gray, area);
    EXPECT_GT(patch.image.at<uchar>(20 - 12, 10), 200);
    EXPECT_NEAR(patch.image.at<uchar>(20, 16), 120, 20);
}

TEST(UprightPatch, MapsThereAndBack) {
    const OrientedBox area{{33.3, 41.7}, 30, 12, 2.1};
    const UprightPatch patch = cutUpright(scene(), area);
    for (const cv::Point2d p : {cv::Point2d(0, 0), cv::Point2d(3.5, 20), cv::Point2d(-4, 60)}) {
        const cv::Point2d back = toPatch(patch.image_from_patch, toImage(patch.image_from_patch, p));
        EXPECT_NEAR(back.x, p.x, 1e-9);
        EXPECT_NEAR(back.y, p.y, 1e-9);
    }
}

TEST(UprightPatch, BoxOfTheWholePatchIsTheArea) {
    for (const double heading : {0.0, 0.4, 1.9, -2.6, kPi}) {
        const OrientedBox area{{60, 45}, 30, 12, heading};
        const UprightPatch patch = cutUpright(scene(), area);
        const OrientedBox box = boxInImage(patch.image_from_patch, {-0.5, -0.5, 12, 30});
        EXPECT_GT(overlap(area, box), 0.999);
        EXPECT_NEAR(turnBetween(area.heading, box.heading), 0, 1e-9);
    }
}

TEST(UprightPatch, BoxesOfThePatchLieWhereItsPixelsDo) {
    const UprightPatch patch = cutUpright(scene(), {{50, 40}, 21, 11, -kPi / 2});  // from (45, 30) on
    const OrientedBox box = boxInImage(patch.image_from_patch, {3, 10, 4, 6});
    EXPECT_NEAR(box.centre.x, 50, 1e-9);
    EXPECT_NEAR(box.centre.y, 43, 1e-9);
    EXPECT_EQ(box.length, 6);
    EXPECT_EQ(box.width, 4);
}

TEST(UprightPatch, MarksWhatLiesOutsideTheImage) {
    const UprightPatch half = cutUpright(scene(), {{0, 45}, 21, 21, -kPi / 2});
    EXPECT_EQ(cv::countNonZero(half.inside), 11 * 21);
    EXPECT_EQ(half.inside.at<uchar>(10, 9), 0);
    EXPECT_EQ(half.inside.at<uchar>(10, 10), 255);
    const UprightPatch outside = cutUpright(scene(), {{-500, 45}, 21, 21, 0.3});
    EXPECT_EQ(cv::countNonZero(outside.inside), 0);
    for (const cv::Point2d centre : {cv::Point2d(1e12, -1e15), {1e12, 45}, {45, -1e12}}) {
        const UprightPatch far = cutUpright(scene(), {centre, 21, 21, 0.3});
        EXPECT_EQ(cv::countNonZero(far.inside), 0);
        EXPECT_EQ(cv::countNonZero(far.image), 0) << "nothing of it is shown";
    }
    // Taller than wide: 30 of its 41 rows lie in the picture of 90.
    const UprightPatch tall = cutUpright(scene(), {{60, 80}, 41, 11, -kPi / 2});
    EXPECT_EQ(cv::countNonZero(tall.inside), 30 * 11);
    EXPECT_EQ(tall.inside.at<uchar>(29, 5), 255);
    EXPECT_EQ(tall.inside.at<uchar>(30, 5), 0);
    const UprightPatch wide = cutUpright(scene(), {{115, 45}, 11, 41, -kPi / 2});
    EXPECT_EQ(cv::countNonZero(wide.inside), 25 * 11);
}

TEST(UprightPatch, PixelsReachHalfAPixelBeyondTheirCentres) {
    const auto inside = [](double x, double y) {
        return cv::countNonZero(insideMask({1, 0, x, 0, 1, y}, {6, 4}, {6, 4}));
    };
    for (const double shift : {-0.5, 0.5}) {
        EXPECT_EQ(inside(shift, 0), 24);
        EXPECT_EQ(inside(0, shift), 24);
        EXPECT_EQ(inside(1.1 * shift, 0), 20);
        EXPECT_EQ(inside(0, 1.1 * shift), 18);
    }
}

TEST(UprightPatch, TakesDegenerateAreas) {
    EXPECT_EQ(cutUpright(scene(), {{5, 5}, 0, 0, 0}).image.size(), cv::Size(1, 1));
    EXPECT_EQ(patchSize({{0, 0}, 1e9, -3, 0}), cv::Size(1, kLargestPatchSide));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const UprightPatch patch = cutUpright(scene(), {{nan, 5}, nan, 4, 0});
    EXPECT_EQ(patch.image.size(), cv::Size(4, 1));
    EXPECT_EQ(cv::countNonZero(patch.inside), 0);
    EXPECT_EQ(cv::countNonZero(patch.image), 0);
    EXPECT_EQ(patch.image_from_patch, cv::Matx23d(1, 0, 0, 0, 1, 0));
    EXPECT_EQ(cutUpright(cv::Mat(1, 1, CV_8UC1, cv::Scalar(3)), {{0, 0}, 5, 3, 1}).image.size(), cv::Size(3, 5));
}

}  // namespace
}  // namespace eyrie::upright_patch_test
