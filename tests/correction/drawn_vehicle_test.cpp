#include "correction/drawn_vehicle.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/geometry/angle.h"

namespace eyrie::drawn_vehicle_test {
namespace {

constexpr int kFrames = 60;
constexpr double kPi = std::numbers::pi;

/// A textured car of 22 × 10 px drives steeply down over a textured ground, in the frames 5 to 54.
class DrivenPicture {
 public:
    static OrientedBox truth(FrameIndex frame) {
        const double heading = 1.2;
        const double way = 2.5 * (frame - 5);
        return {{110 + way * std::cos(heading), 30 + way * std::sin(heading)}, 22, 10, heading};
    }
    cv::Mat operator()(FrameIndex frame) const {
        if (frame < 0 || frame >= kFrames) return {};
        cv::Mat picture = ground_.clone();
        if (frame < 5 || frame > 54) return picture;
        const OrientedBox box = truth(frame);
        const cv::Point2d d = box.direction(), corner = box.toImage({-11, -5});
        const cv::Matx23d place(d.x, -d.y, corner.x, d.y, d.x, corner.y);
        cv::warpAffine(car_, picture, place, picture.size(), cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
        return picture;
    }

 private:
    static cv::Mat noise(cv::Size size, int seed, double blur, double low, double high) {
        cv::Mat picture(size, CV_8UC1);
        cv::RNG dice(static_cast<std::uint64_t>(seed));
        dice.fill(picture, cv::RNG::UNIFORM, 0, 256);
        cv::GaussianBlur(picture, picture, {}, blur);
        cv::normalize(picture, picture, low, high, cv::NORM_MINMAX);
        return picture;
    }
    cv::Mat ground_ = noise({240, 200}, 1, 2.5, 60, 140);
    cv::Mat car_ = noise({23, 11}, 2, 1.2, 20, 250);
};

OrientedBox drawnIn(FrameIndex frame) {
    return DrivenPicture::truth(frame).upright();
}

const CameraMotion kStill = CameraMotion::standing(0, kFrames - 1);

TEST(DrawnVehicle, IsFollowedBothWaysAndTurnedIntoItsMotion) {
    const DrawnVehicle vehicle = followBothWays(drawnIn(30), 30, 0, kFrames - 1, DrivenPicture(), kStill);
    ASSERT_TRUE(areSightings(vehicle.sightings));
    EXPECT_LE(vehicle.sightings.front().frame, 7) << vehicle.ended_before;
    EXPECT_GE(vehicle.sightings.front().frame, 4) << "before that it was not there";
    EXPECT_GE(vehicle.sightings.back().frame, 52) << vehicle.ended_after;
    EXPECT_LE(vehicle.sightings.back().frame, 56);
    for (const Sighting& each : vehicle.sightings) {
        if (each.frame < 5 || each.frame > 54) continue;
        const OrientedBox truth = DrivenPicture::truth(each.frame);
        EXPECT_GT(overlap(each.box, truth), 0.5) << each.frame;
        EXPECT_LT(std::abs(turnBetween(each.box.heading, truth.heading)), 0.2) << each.frame;
    }
}

TEST(DrawnVehicle, ItIsToldHowFarItIsAndHowMuchMayBeLeft) {
    std::vector<DrawnVehicleAdvance> told;
    followBothWays(drawnIn(30), 30, 20, 33, DrivenPicture(), kStill,
                   [&](const DrawnVehicleAdvance& advance) { told.push_back(advance); });
    ASSERT_EQ(told.size(), 13U);
    for (int i = 0; i < 13; ++i) {
        const DrawnVehicleAdvance& each = told[static_cast<std::size_t>(i)];
        EXPECT_EQ(each.frame, i < 3 ? 31 + i : 32 - i);
        EXPECT_EQ(each.backwards, i >= 3);
        EXPECT_EQ(each.done, i + 1);
        EXPECT_EQ(each.most_left, 12 - i);
    }
}

TEST(DrawnVehicle, WhatWasFollowedIsKeptWhenItIsStopped) {
    std::stop_source stop;
    const DrawnVehicle vehicle = followBothWays(
        drawnIn(30), 30, 0, kFrames - 1, DrivenPicture(), kStill,
        [&](const DrawnVehicleAdvance& advance) { advance.frame == 40 ? stop.request_stop() : false; },
        stop.get_token());
    ASSERT_EQ(vehicle.sightings.size(), 11U);
    EXPECT_EQ(vehicle.sightings.front().frame, 30);
    EXPECT_EQ(vehicle.sightings.back().frame, 40);
    EXPECT_THAT(vehicle.ended_after, testing::HasSubstr("by hand"));
}

TEST(DrawnVehicle, AtTheEndsOfTheRunThereIsOneWayOnly) {
    const DrawnVehicle vehicle = followBothWays(drawnIn(30), 30, 30, 33, DrivenPicture(), kStill);
    ASSERT_EQ(vehicle.sightings.size(), 4U);
    EXPECT_EQ(vehicle.sightings.front().frame, 30);
    EXPECT_THROW(followBothWays({{50, 50}, 1, 1, 0}, 30, 0, 33, DrivenPicture(), kStill), Error);
}

TEST(TurnedIntoMotion, AVehicleThatDrivesDownThePictureIsLongDownwards) {
    std::vector<Sighting> seen;
    for (int frame = 0; frame < 30; ++frame) seen.push_back({frame, {{50, 20 + 2.0 * frame}, 10, 24, 0}});
    for (const Sighting& each : turnedIntoMotion(seen, kStill)) {
        EXPECT_NEAR(each.box.heading, kPi / 2, 1e-9);
        EXPECT_NEAR(each.box.length, 24, 1e-9);
        EXPECT_NEAR(each.box.width, 10, 1e-9);
    }
}

TEST(TurnedIntoMotion, OnTheDiagonalTheUsualShapeIsTaken) {
    std::vector<Sighting> seen;
    for (int frame = 0; frame < 30; ++frame) seen.push_back({frame, {{50 - 2.0 * frame, 20 + 2.0 * frame}, 20, 20, 0}});
    for (const Sighting& each : turnedIntoMotion(seen, kStill)) {
        EXPECT_NEAR(each.box.heading, 3 * kPi / 4, 1e-9);
        EXPECT_NEAR(each.box.length / each.box.width, 2.2, 1e-6);
        EXPECT_NEAR(each.box.upright().length, 20, 1e-6);
    }
}

TEST(TurnedIntoMotion, WaysOnBothSidesOfACutCount) {
    // The camera's motion is not known from frame 9 to 10. Before that it stands, behind it drives down the picture.
    std::vector<Homography> steps;
    for (int frame = 0; frame < 29; ++frame) {
        if (frame == 9) continue;
        Homography step;
        step.from_frame = frame;
        step.to_frame = frame + 1;
        steps.push_back(step);
    }
    const CameraMotion cut(steps);
    ASSERT_FALSE(cut.connects(9, 10));
    std::vector<Sighting> seen;
    seen.reserve(30);
    for (int frame = 0; frame < 30; ++frame)
        seen.push_back({frame, {{200, frame < 10 ? 20.0 : 300 + 2.0 * frame}, 10, 24, 0}});
    for (const Sighting& each : turnedIntoMotion(seen, cut)) EXPECT_NEAR(each.box.heading, kPi / 2, 1e-9);
    // To the right before, and to the left twice as far behind it: the longer way tells.
    for (Sighting& each : seen) {
        each.box.centre =
            each.frame < 10 ? cv::Point2d(100 + 6.0 * each.frame, 50) : cv::Point2d(600 - 6.0 * each.frame, 90);
        std::swap(each.box.length, each.box.width);
    }
    for (const Sighting& each : turnedIntoMotion(seen, cut)) EXPECT_NEAR(std::abs(each.box.heading), kPi, 1e-9);
}

TEST(TurnedIntoMotion, WhatStandsOrIsNotConnectedStaysAsItWasDrawn) {
    std::vector<Sighting> seen;
    for (int frame = 0; frame < 30; ++frame) seen.push_back({frame, {{50.0 + (frame % 2), 20}, 12, 24, 0}});
    EXPECT_EQ(turnedIntoMotion(seen, kStill), seen);
    for (Sighting& each : seen) each.box.centre.x = 3.0 * each.frame;
    EXPECT_EQ(turnedIntoMotion(seen, CameraMotion()), seen);
}

}  // namespace
}  // namespace eyrie::drawn_vehicle_test
