#include "tracking/vehicle_template.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angle.h"
#include "tracking/drawn_cars.h"

namespace eyrie::vehicle_template_test {
namespace {

using test::drawnCars;

double distance(cv::Point2d a, cv::Point2d b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

VehicleTemplate lookAt(const OrientedBox& car) {
    const auto look = VehicleTemplate::of(drawnCars({car}), car);
    EXPECT_TRUE(look);
    return look.value_or(VehicleTemplate{});
}

const OrientedBox kCar{{120, 90}, 22, 10, 0};

}  // namespace

TEST(VehicleTemplate, isFoundToAPartOfAPixelAfterTheCameraHasTurned) {
    OrientedBox before = kCar;
    before.heading = radiansFromDegrees(30);
    OrientedBox now = before;
    now.centre = {161.5, 120.25};
    now.heading = radiansFromDegrees(75);
    OrientedBox expected = now;
    expected.centre += cv::Point2d(1.7, -1.2);
    const auto match = lookAt(before).find(drawnCars({now}, 8), expected, 3);
    ASSERT_TRUE(match);
    EXPECT_LT(distance(match->centre, now.centre), 0.3);
    EXPECT_GT(match->agreement, 0.9);
    EXPECT_LT(match->beside, 0.7);
}

TEST(VehicleTemplate, isFoundUpToTheEndsOfItsReachOnAllSides) {
    const VehicleTemplate look = lookAt(kCar);
    for (const cv::Point2d off : {cv::Point2d(4, 0), {-4, 0}, {0, 4}, {0, -4}, {4, -4}, {-4, 4}}) {
        OrientedBox expected = kCar;
        expected.centre += off;
        const auto match = look.find(drawnCars({kCar}, 8), expected, 4);
        ASSERT_TRUE(match) << off;
        EXPECT_LT(distance(match->centre, kCar.centre), 0.4) << off;
        EXPECT_GT(match->agreement, 0.9) << off;
    }
}

TEST(VehicleTemplate, isNotLookedForBeyondItsReach) {
    const VehicleTemplate look = lookAt(kCar);
    for (const double reach : {0.0, 1.0, 3.0}) {
        const double farthest = std::max(1.0, reach);
        OrientedBox expected = kCar;
        expected.centre.x += farthest + 2;
        const auto match = look.find(drawnCars({kCar}, 8), expected, reach);
        ASSERT_TRUE(match) << reach;
        EXPECT_NEAR(expected.centre.x - match->centre.x, farthest, 0.01) << "as near as it may look, a pixel at least";
    }
}

TEST(VehicleTemplate, followsAZoomOfTheCamera) {
    const OrientedBox now{{200, 150}, 28.6, 13, 0};
    const auto match = lookAt(kCar).find(drawnCars({now}, 8), now, 2);
    ASSERT_TRUE(match);
    EXPECT_LT(distance(match->centre, now.centre), 0.5);
    EXPECT_GT(match->agreement, 0.85);
}

TEST(VehicleTemplate, ofALargeVehicleIsFoundAsWell) {
    const OrientedBox lorry{{200, 150}, 120, 34, radiansFromDegrees(-20)};
    OrientedBox expected = lorry;
    expected.centre += cv::Point2d(4, 3);
    const auto match = lookAt(lorry).find(drawnCars({lorry}, 8), expected, 8);
    ASSERT_TRUE(match);
    EXPECT_LT(distance(match->centre, lorry.centre), 0.7);
    EXPECT_GT(match->agreement, 0.9);
}

TEST(VehicleTemplate, doesNotDependOnTheLight) {
    const VehicleTemplate look = lookAt(kCar);
    for (const auto& [contrast, brightness] : {std::pair(0.5, 10.0), {1.2, 0.0}, {0.7, 70.0}}) {
        cv::Mat lit;
        drawnCars({kCar}, 8).convertTo(lit, CV_8UC1, contrast, brightness);
        const auto match = look.find(lit, kCar, 2);
        ASSERT_TRUE(match) << contrast;
        EXPECT_GT(match->agreement, 0.9) << contrast;
    }
}

TEST(VehicleTemplate, isNotThatOfPlainOrTexturedRoadNorOfAnotherVehicle) {
    const VehicleTemplate look = lookAt(kCar);
    EXPECT_FALSE(look.find(drawnCars({}), kCar, 3)) << "no contrast";
    cv::Mat road(300, 400, CV_8UC1);
    cv::RNG(3).fill(road, cv::RNG::NORMAL, 90, 25);
    for (int blur : {1, 3, 7, 15}) {
        cv::Mat texture;
        cv::GaussianBlur(road, texture, {blur, blur}, 0);
        const auto match = look.find(texture, kCar, 3);
        if (match) {
            EXPECT_LT(match->agreement, 0.6) << blur;
        }
    }
    OrientedBox across = kCar;
    across.heading = kPi / 2;
    const auto other = look.find(drawnCars({across}), kCar, 3);
    ASSERT_TRUE(other);
    EXPECT_LT(other->agreement, 0.6);
}

TEST(VehicleTemplate, isNotTakenWithoutContrastOrBeyondTheImage) {
    EXPECT_FALSE(VehicleTemplate::of(drawnCars({}), kCar));
    EXPECT_FALSE(VehicleTemplate::of({}, kCar));
    const OrientedBox cut{{3, 60}, 22, 10, 0};
    EXPECT_FALSE(VehicleTemplate::of(drawnCars({cut}), cut));
    const OrientedBox speck{{60, 60}, 2, 2, 0};
    EXPECT_FALSE(VehicleTemplate::of(drawnCars({speck}), speck));
    const OrientedBox nowhere{{NAN, 60}, 22, 10, 0};
    EXPECT_FALSE(VehicleTemplate::of(drawnCars({}), nowhere));
    EXPECT_FALSE(lookAt(kCar).find({}, kCar, 3));
    EXPECT_FALSE(lookAt(kCar).find(drawnCars({cut}), cut, 3));
}

}  // namespace eyrie::vehicle_template_test
