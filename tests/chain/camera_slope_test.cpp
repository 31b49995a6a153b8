// What the way of the camera over flat ground says of how its scale grows downwards.
#include "chain/scale/camera_slope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "chain/scale/scale_slope_fit.h"

namespace eyrie::camera_slope_test {
namespace {

const cv::Size kImage{960, 540};
constexpr int kSteps = 33;

/// A camera over a plane, and what it does from one picture to the next.
struct Flight {
    double growth = 0;        ///< from the middle to the lower edge
    cv::Point2d way{0, 0};    ///< over the ground, to the right and ahead; the distance of the middle is 1
    cv::Vec3d turn{0, 0, 0};  ///< radians
    double focal_length = 1;  ///< in widths of the picture

    /// The map of each picture into the next one.
    cv::Matx33d step() const {
        const double f = focal_length * kImage.width;
        const cv::Matx33d camera(f, 0, (kImage.width - 1) / 2.0, 0, f, (kImage.height - 1) / 2.0, 0, 0, 1);
        const double tilt = growth * f / (kImage.height / 2.0);
        // Along the ground: nothing of it across the plane (0, tilt, 1).
        const double ahead = way.y / std::hypot(1, tilt);
        const cv::Matx31d moved(-way.x, ahead, -tilt * ahead);
        const cv::Matx33d over_ground = cv::Matx33d::eye() + moved * cv::Matx13d(0, tilt, 1);
        const double angle = cv::norm(turn);
        const cv::Matx33d cross(0, -turn[2], turn[1], turn[2], 0, -turn[0], -turn[1], turn[0], 0);
        const cv::Matx33d turned = angle > 0 ? cv::Matx33d::eye() + cross * (std::sin(angle) / angle) +
                                                   cross * cross * ((1 - std::cos(angle)) / (angle * angle))
                                             : cv::Matx33d::eye();
        return camera * turned * over_ground * camera.inv();
    }
    CameraSlope slope(int stretches = 1) const {
        CameraSlope found(kImage);
        for (int i = 0; i < stretches; ++i) found.add(std::vector<cv::Matx33d>(kSteps, step()));
        return found;
    }
};

double likeliest(const CameraSlope& slope) {
    double best = 0;
    for (int i = -90; i <= 300; ++i) {
        const double growth = 0.01 * i;
        if (slope.cost(growth) < slope.cost(best)) best = growth;
    }
    return best;
}

}  // namespace

TEST(CameraSlope, AFlightTellsHowObliqueTheViewIs) {
    for (const double growth : {0.0, 0.3, 0.6, 1.5}) {
        for (const cv::Point2d way : {cv::Point2d(0.002, 0), cv::Point2d(0, 0.003), cv::Point2d(-0.002, 0.002)}) {
            const CameraSlope found = Flight{growth, way}.slope();
            EXPECT_NEAR(likeliest(found), growth, 0.05 + 0.05 * growth) << growth << ' ' << way;
            EXPECT_GT(found.cost(growth * 0.7 - 0.4), 3) << growth << ' ' << way;
            EXPECT_GT(found.cost(growth + 0.4 + growth), 1.5) << growth << ' ' << way;
        }
    }
}

TEST(CameraSlope, TheFocalLengthNeedNotBeKnownNorTheTurnAboutTheLineOfSight) {
    for (const double focal_length : {0.8, 1.2}) {
        const Flight flight{0.6, {0.002, 0.001}, {0, 0, 0.003}, focal_length};
        EXPECT_NEAR(likeliest(flight.slope()), 0.6, 0.08) << focal_length;
    }
}

TEST(CameraSlope, WhoHoversOrOnlyTurnsSaysNothing) {
    for (const cv::Vec3d& turn : {cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0.004), cv::Vec3d(0.0004, 0.0003, 0)}) {
        const CameraSlope found = Flight{0.6, {0, 0}, turn}.slope();
        for (const double growth : {-0.5, 0.0, 0.5, 0.9}) EXPECT_LT(found.cost(growth), 1) << turn << growth;
    }
}

TEST(CameraSlope, WhatIsNoPlaneSaysNothing) {
    CameraSlope found(kImage);
    // Grows to the right by a third and shrinks downwards by as much: no camera over no plane sees that.
    cv::Matx33d step = cv::Matx33d::eye();
    step(0, 0) = 1.01;
    step(1, 1) = 0.99;
    found.add(std::vector<cv::Matx33d>(kSteps, step));
    for (const double growth : {-0.5, 0.0, 0.5}) EXPECT_EQ(found.cost(growth), 0) << growth;
}

TEST(CameraSlope, AShortWaySaysNothingAndEachStretchNoMoreThanTen) {
    CameraSlope found(kImage);
    const Flight flight{0.6, {0.003, 0}};
    found.add(std::vector<cv::Matx33d>(7, flight.step()));
    EXPECT_EQ(found.cost(0), 0);
    EXPECT_NEAR(flight.slope().cost(-0.5), 10, 1e-9);
    EXPECT_NEAR(flight.slope(3).cost(-0.5), 30, 1e-9);
    EXPECT_LT(flight.slope(3).cost(0.6), 0.3);
    EXPECT_EQ(flight.slope().cost(9), flight.slope().cost(6)) << "the last one goes on";
}

TEST(CameraSlope, AWayEndsWhereRegistrationsAreNotReliable) {
    CameraWay way;
    Registration registration;
    registration.state = RegistrationState::first;
    way.add(registration);
    EXPECT_TRUE(way.steps().empty());
    registration.current_from_previous.matrix(0, 2) = 3;
    for (const RegistrationState state : {RegistrationState::registered, RegistrationState::frozen}) {
        registration.state = state;
        way.add(registration);
    }
    EXPECT_EQ(way.steps().size(), 2U);
    EXPECT_EQ(way.steps().front()(0, 2), 3);
    registration.state = RegistrationState::failed;
    way.add(registration);
    registration.state = RegistrationState::registered;
    way.add(registration);
    EXPECT_EQ(way.steps().size(), 2U) << "what comes after a gap is another way";
}

TEST(ScaleSlopeFit, WhereNothingDrivesTheCameraTellsTheSlopeAlone) {
    const Flight flight{0.6, {0.002, 0.001}};
    const ScaleSlope found = fitSlope({}, kImage, 0.1, flight.slope());
    EXPECT_NEAR(found.down_per_px, 0.6 / 270, 0.06 / 270);
    EXPECT_EQ(found.right_per_px, 0);
    EXPECT_TRUE(fitSlope({}, kImage, 0.1, Flight{0.1, {0.002, 0.001}}.slope()).isFlat()) << "it hardly matters";
    EXPECT_TRUE(fitSlope({}, kImage, 0.1, Flight{0, {0.002, 0.001}}.slope()).isFlat());
}

TEST(ScaleSlopeFit, AScaleReadOffVehiclesHoldsWhereTheyAre) {
    const Flight flight{0.6, {0.002, 0.001}};
    constexpr double kGsd = 0.2;
    const auto votes = [](double gsd) {
        std::vector<ScaleVote> all;
        all.reserve(8);
        for (int i = 0; i < 8; ++i) all.push_back({cv::Point2d(300 + 40 * i, 90 + i % 3), gsd, 8});
        return all;
    };
    // At the upper edge of the traffic a metre covers .6 of what it does in the middle.
    const ScaleSlope there = fitSlope(votes(kGsd), kImage, kGsd, flight.slope());
    EXPECT_EQ(there.centre(), cv::Point2d(460, 91));
    EXPECT_NEAR(there.factorAt({480, 269.5}), 1 / 0.6, 0.06) << "the same slope, counted from there";
    const ScaleSlope middle = fitSlope(votes(kGsd / 0.6), kImage, kGsd, flight.slope());
    EXPECT_EQ(middle.centre(), cv::Point2d(479.5, 269.5)) << "they say that it is that of the middle";
    std::vector<ScaleVote> few = votes(kGsd);
    few.resize(5);
    EXPECT_EQ(fitSlope(few, kImage, kGsd, flight.slope()).centre(), cv::Point2d(479.5, 269.5));
}

TEST(ScaleSlopeFit, VehiclesALittleAwayFromTheMiddleSayWhetherAScaleIsItsOrTheirs) {
    const Flight flight{0.6, {0.002, 0.001}};
    for (const double y : {179.5, 359.5}) {
        // A metre covers .8 of what it does in the middle, or 1.2.
        const double factor = 1 + 0.6 * (y - 269.5) / 270;
        const auto centreWhere = [&](double gsd_of_vehicles) {
            std::vector<ScaleVote> votes;
            votes.reserve(10);
            for (int i = 0; i < 10; ++i) votes.push_back({cv::Point2d(300 + 40 * i, y), gsd_of_vehicles, 8});
            return fitSlope(votes, kImage, 0.2, flight.slope()).centre();
        };
        EXPECT_EQ(centreWhere(0.2 / factor), cv::Point2d(479.5, 269.5)) << y;
        EXPECT_EQ(centreWhere(0.2), cv::Point2d(500, y));
    }
}

TEST(ScaleSlopeFit, ManyVehiclesOutweighTheCamera) {
    std::vector<ScaleVote> votes;
    votes.reserve(200);
    for (int i = 0; i < 200; ++i) votes.push_back({cv::Point2d(20 + i * 37 % 900, 20 + i * 53 % 500), 0.1, 8});
    EXPECT_TRUE(fitSlope(votes, kImage, 0.1, Flight{0.6, {0.002, 0.001}}.slope()).isFlat());
}

}  // namespace eyrie::camera_slope_test
