// What a grid takes for a vehicle, on plain pictures whose pixels are its places.
#include <gtest/gtest.h>

#include "tracking/silhouettes/silhouette_grid.h"

namespace eyrie::silhouette_limits_test {
namespace {

// 44 × 32 places, each on a pixel: place 0 is pixel 0.
const SilhouetteGrid kPlaces({{21.5, 15.5}, 24, 12, 0}, 10, 1);
const cv::Rect kCar(10, 10, 24, 12);

cv::Mat plain(double ground = 150) {
    return cv::Mat(32, 44, CV_8UC1, cv::Scalar(ground));
}

cv::Mat with(cv::Mat picture, const cv::Rect& area, double paint) {
    picture(area).setTo(paint);
    return picture;
}

std::optional<Silhouette> seen(const cv::Mat& vehicle, double ground = 150) {
    return kPlaces.compare(vehicle, {plain(ground)});
}

void expectEdges(const BoxEdges& edges, const cv::Rect& area) {
    EXPECT_NEAR(edges.rear, area.x - 22, 1e-9);
    EXPECT_NEAR(edges.front, area.br().x - 22, 1e-9);
    EXPECT_NEAR(edges.left, area.y - 16, 1e-9);
    EXPECT_NEAR(edges.right, area.br().y - 16, 1e-9);
}

}  // namespace

TEST(SilhouetteLimits, EdgesAreThoseOfThePixels) {
    for (const cv::Rect& area : {kCar, cv::Rect(8, 9, 20, 11), cv::Rect(15, 13, 25, 14)}) {
        const auto silhouette = seen(with(plain(), area, 230));
        ASSERT_TRUE(silhouette && silhouette->lit);
        expectEdges(silhouette->whole, area);
        expectEdges(*silhouette->lit, area);
        EXPECT_TRUE(silhouette->lit_vehicle);
        EXPECT_NEAR(silhouette->whole.area(), area.area(), 1e-9);
    }
}

TEST(SilhouetteLimits, EdgesArePixelsHoweverFineTheGrid) {
    const SilhouetteGrid fine({{21.5, 15.5}, 20, 8, 0}, 10, 0.5);
    const cv::Rect area(8, 9, 20, 11);
    const auto silhouette = fine.compare(fine.sampled(with(plain(), area, 230)), {fine.sampled(plain())});
    ASSERT_TRUE(silhouette);
    EXPECT_NEAR(silhouette->whole.rear, area.x - 22, 0.51);
    EXPECT_NEAR(silhouette->whole.front, area.br().x - 22, 0.51);
    EXPECT_NEAR(silhouette->whole.left, area.y - 16, 0.51);
    EXPECT_NEAR(silhouette->whole.right, area.br().y - 16, 0.51);
}

TEST(SilhouetteLimits, SamplesUpToTheBordersOfThePictureAndNotBeyond) {
    cv::Mat picture(32, 44, CV_8UC1);
    cv::RNG(5).fill(picture, cv::RNG::UNIFORM, 0, 256);
    EXPECT_EQ(cv::norm(kPlaces.sampled(picture), picture, cv::NORM_INF), 0);
    EXPECT_TRUE(kPlaces.sampled(picture.colRange(0, 43)).empty());
    EXPECT_TRUE(kPlaces.sampled(picture.rowRange(0, 31)).empty());
    for (const cv::Point2d off : {cv::Point2d(-0.1, 0), cv::Point2d(0.1, 0), cv::Point2d(0, -0.1), cv::Point2d(0, 0.1)})
        EXPECT_TRUE(kPlaces.sampled(picture, {1, 0, off.x, 0, 1, off.y, 0, 0, 1}).empty()) << off;
}

TEST(SilhouetteLimits, SamplesInTheAxesOfTheBoxThroughAnyMap) {
    cv::Mat slope(100, 120, CV_8UC1);
    for (int y = 0; y < slope.rows; ++y) {
        for (int x = 0; x < slope.cols; ++x) slope.at<uchar>(y, x) = static_cast<uchar>(x + y + (x > 60 ? 20 : 0));
    }
    // Heading down the picture, so that its right is the picture's left.
    const SilhouetteGrid down({{59.5, 49.5}, 10, 6, CV_PI / 2}, 2, 1);
    const cv::Mat found = down.sampled(slope);
    ASSERT_EQ(found.size(), cv::Size(14, 10));
    for (int y = 0; y < found.rows; ++y) {
        for (int x = 0; x < found.cols; ++x)
            ASSERT_EQ(found.at<uchar>(y, x), slope.at<uchar>(43 + x, 64 - y)) << x << ' ' << y;
    }
    const cv::Mat further = down.sampled(slope, {2, 0, 10, 0, 2, -6, 0, 0, 2});
    EXPECT_EQ(further.at<uchar>(0, 0), slope.at<uchar>(40, 69));
    EXPECT_EQ(SilhouetteGrid({{20, 20}, 1, 1, 0}, 0, 1).sampled(slope).size(), cv::Size(5, 5)) << "at least";
}

TEST(SilhouetteLimits, DiffersByTwelveGreyLevelsAndATenthOfTheGround) {
    for (const double sign : {1.0, -1.0}) {
        EXPECT_FALSE(seen(with(plain(100), kCar, 100 + sign * 12), 100));
        EXPECT_TRUE(seen(with(plain(100), kCar, 100 + sign * 13), 100));
        EXPECT_FALSE(seen(with(plain(200), kCar, 200 + sign * 20), 200));
        EXPECT_TRUE(seen(with(plain(200), kCar, 200 + sign * 21), 200));
    }
}

TEST(SilhouetteLimits, ShadeIsAQuarterToSixSeventhsOfTheGroundsBrightness) {
    const auto isLit = [](double paint) {
        const auto silhouette = seen(with(plain(200), kCar, paint), 200);
        return silhouette && silhouette->lit;
    };
    EXPECT_TRUE(isLit(170));
    EXPECT_FALSE(isLit(168));
    EXPECT_FALSE(isLit(52));
    EXPECT_TRUE(isLit(50)) << "blacker than any shade";
}

TEST(SilhouetteLimits, OnlyGroundThatIsDarkInAllPicturesIsNight) {
    EXPECT_FALSE(seen(with(plain(59), kCar, 230), 59));
    EXPECT_TRUE(seen(with(plain(61), kCar, 230), 61));
    EXPECT_TRUE(kPlaces.compare(with(plain(), kCar, 230), {plain(50), plain(150)}));
    EXPECT_FALSE(kPlaces.compare(with(plain(), kCar, 230), {plain(50), plain(40)}));
}

TEST(SilhouetteLimits, WhatSticksOutNarrowlyIsFringe) {
    // A third of the car's width is bonnet, a quarter is a mirror or a pole.
    cv::Mat bonnet = with(plain(), kCar, 230);
    EXPECT_NEAR(seen(with(bonnet, {34, 13, 4, 4}, 230))->whole.front, 16, 1e-9);
    cv::Mat pole = with(plain(), kCar, 230);
    EXPECT_NEAR(seen(with(pole, {34, 13, 4, 3}, 230))->whole.front, 12, 1e-9);
    cv::Mat side = with(plain(), kCar, 230);
    EXPECT_NEAR(seen(with(side, {20, 7, 8, 3}, 230))->whole.left, -9, 1e-9);
    cv::Mat mirror = with(plain(), kCar, 230);
    EXPECT_NEAR(seen(with(mirror, {20, 7, 7, 3}, 230))->whole.left, -6, 1e-9);
}

TEST(SilhouetteLimits, TheVehicleReachesIntoTheMiddleThird) {
    // Columns 14 … 29, rows 10 … 21.
    EXPECT_FALSE(seen(with(plain(), {4, 10, 10, 12}, 230)));
    EXPECT_TRUE(seen(with(plain(), {4, 10, 11, 12}, 230)));
    EXPECT_FALSE(seen(with(plain(), {30, 10, 10, 12}, 230)));
    EXPECT_TRUE(seen(with(plain(), {29, 10, 10, 12}, 230)));
    EXPECT_FALSE(seen(with(plain(), {12, 2, 20, 8}, 230)));
    EXPECT_TRUE(seen(with(plain(), {12, 2, 20, 9}, 230)));
    EXPECT_FALSE(seen(with(plain(), {12, 22, 20, 8}, 230)));
    EXPECT_TRUE(seen(with(plain(), {12, 21, 20, 8}, 230)));
}

TEST(SilhouetteLimits, OfSeveralThingsTheVehicleIsWhatCoversMostOfTheMiddle) {
    const cv::Rect car(16, 12, 14, 8);
    cv::Mat picture = with(plain(), car, 230);
    with(picture, {2, 2, 30, 7}, 230);    // larger, but beside it
    with(picture, {16, 23, 14, 4}, 230);  // beside it, too
    const auto silhouette = seen(picture);
    ASSERT_TRUE(silhouette);
    expectEdges(silhouette->whole, car);
}

TEST(SilhouetteLimits, WhatReachesAnyBorderOfTheGridIsNotTheVehicleAlone) {
    EXPECT_TRUE(seen(with(plain(), {2, 10, 32, 12}, 230)));
    EXPECT_FALSE(seen(with(plain(), {0, 10, 34, 12}, 230)));
    EXPECT_TRUE(seen(with(plain(), {10, 10, 32, 12}, 230)));
    EXPECT_FALSE(seen(with(plain(), {10, 10, 34, 12}, 230)));
    EXPECT_TRUE(seen(with(plain(), {10, 2, 24, 20}, 230)));
    EXPECT_FALSE(seen(with(plain(), {10, 0, 24, 22}, 230)));
    EXPECT_TRUE(seen(with(plain(), {10, 10, 24, 20}, 230)));
    EXPECT_FALSE(seen(with(plain(), {10, 10, 24, 22}, 230)));
}

TEST(SilhouetteLimits, SurelyTheVehicleIsWhatIsLargeLongWideAndFull) {
    const auto isSure = [](const cv::Rect& lit, const cv::Rect& hole = {}) {
        const auto silhouette = seen(with(with(with(plain(), kCar, 80), lit, 230), hole, 80));
        EXPECT_TRUE(silhouette && silhouette->lit);
        return silhouette && silhouette->lit_vehicle;
    };
    // Of 24 × 12 px.
    EXPECT_TRUE(isSure({16, 12, 18, 8})) << "half of it";
    EXPECT_FALSE(isSure({16, 12, 12, 8})) << "a third of it";
    EXPECT_TRUE(isSure({18, 10, 16, 12})) << "a third longer than wide";
    EXPECT_FALSE(isSure({19, 10, 15, 12})) << "a quarter longer than wide";
    EXPECT_TRUE(isSure({10, 12, 24, 8})) << "two thirds as wide as the box";
    EXPECT_FALSE(isSure({10, 12, 24, 7})) << "seven twelfths: a roof or a window alone";
    EXPECT_TRUE(isSure(kCar, {14, 13, 16, 7})) << "61 % full";
    EXPECT_FALSE(isSure(kCar, {14, 13, 17, 7})) << "59 % full";
}

}  // namespace eyrie::silhouette_limits_test
