// How directions on the ground are carried from picture to picture.
#include "tracking/pictures/ground_turns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tracking/frame_summaries.h"

namespace eyrie::ground_turns_test {
namespace {

GroundMotion moving(const cv::Matx33d& step, int frames, int cut_at = -1, const ScaleSlope& slope = {}) {
    GroundMotion ground;
    ground.seenAt(slope);
    for (FrameIndex frame = 0; frame < frames; ++frame) {
        FrameMotionSummary summary = test::summaryOfFrame(frame);
        if (frame > 0) summary.registration.current_from_previous.matrix = step;
        if (frame == cut_at) summary.registration.state = RegistrationState::failed;
        ground.add(summary);
    }
    return ground;
}

/// About the middle of a picture of 640 × 360 px.
cv::Matx33d similarity(double turn, double scale) {
    const double c = scale * std::cos(turn);
    const double s = scale * std::sin(turn);
    return {c, -s, 320 - c * 320 + s * 180, s, c, 180 - s * 320 - c * 180, 0, 0, 1};
}

}  // namespace

TEST(GroundTurns, AddUpFromTheFirstPictureOfAStretch) {
    const GroundTurns turns(moving(similarity(0.03, 1.02), 12), 2, 11);
    for (FrameIndex frame = 2; frame < 12; ++frame) {
        EXPECT_EQ(turns.at(frame).stretch, 2);
        EXPECT_NEAR(turns.at(frame).angle, 0.03 * (frame - 2), 1e-9);
        EXPECT_NEAR(turns.at(frame).enlargement, std::pow(1.02, frame - 2), 1e-9);
    }
}

TEST(GroundTurns, AreThoseOfTheMiddleOfAPictureSeenAtAnAngle) {
    const cv::Matx33d step(1.01, 0.02, 3, -0.01, 0.99, -2, 1e-4, 3e-4, 1);
    const auto mapped = [&](double x, double y) {
        const cv::Vec3d there = step * cv::Vec3d(x, y, 1);
        return cv::Point2d(there[0] / there[2], there[1] / there[2]);
    };
    // A pixel to the right of the middle and one down from it.
    const cv::Point2d right = (mapped(320.5, 180) - mapped(319.5, 180));
    const cv::Point2d down = (mapped(320, 180.5) - mapped(320, 179.5));
    const GroundTurns turns(moving(step, 3), 0, 2);
    EXPECT_NEAR(turns.at(1).angle, std::atan2(right.y, right.x), 1e-4);
    EXPECT_NEAR(turns.at(1).enlargement, std::sqrt(right.cross(down)), 1e-4);
    EXPECT_NEAR(turns.at(2).enlargement, right.cross(down), 1e-4);
}

TEST(GroundTurns, BeginAnewWhereRegistrationFailed) {
    const GroundTurns turns(moving(similarity(0.03, 1.02), 12, 5), 0, 11);
    EXPECT_EQ(turns.at(4).stretch, 0);
    EXPECT_EQ(turns.at(5).stretch, 5);
    EXPECT_EQ(turns.at(5).angle, 0);
    EXPECT_EQ(turns.at(5).enlargement, 1);
    EXPECT_EQ(turns.at(11).stretch, 5);
    EXPECT_NEAR(turns.at(11).angle, 0.18, 1e-9);
}

TEST(GroundTurns, BeginAnewWhereTheyHaveGrownBeyondTrust) {
    for (const double zoom : {1.1, 1 / 1.1}) {
        const GroundTurns turns(moving(similarity(0.03, zoom), 12), 0, 11);
        EXPECT_EQ(turns.at(4).stretch, 0);
        EXPECT_NEAR(turns.at(4).enlargement, std::pow(zoom, 4), 1e-9);
        EXPECT_EQ(turns.at(5).stretch, 5) << "1.1 to the fifth is 1.61";
        EXPECT_EQ(turns.at(5).angle, 0);
        EXPECT_EQ(turns.at(5).enlargement, 1);
        EXPECT_EQ(turns.at(9).stretch, 5);
    }
}

TEST(GroundTurns, FlyingOnOverGroundSeenAtAnAngleIsNoZoom) {
    // Half as much again 100 px further down.
    constexpr double kGrowth = 0.005;
    const ScaleSlope slope{0, kGrowth, 320, 180};
    constexpr double kForward = 0.02;
    // A plane under a camera that flies on: scales about the point on the horizon that it flies to, the more the
    // nearer.
    const double horizon = 180 - 1 / kGrowth;
    const cv::Matx33d to_horizon(1, 0, -320, 0, 1, -horizon, 0, 0, 1);
    const cv::Matx33d step = to_horizon.inv() * cv::Matx33d(1, 0, 0, 0, 1, 0, 0, -kForward * kGrowth, 1) * to_horizon;
    const GroundTurns turns(moving(step, 60, -1, slope), 0, 59);
    const GroundTurns unknown(moving(step, 60), 0, 59);
    EXPECT_EQ(turns.at(59).stretch, 0);
    EXPECT_NEAR(turns.at(59).enlargement, 1, 1e-6);
    EXPECT_GT(unknown.at(59).stretch, 0) << "grown beyond trust where the slope is not known";
}

TEST(GroundTurns, BeginAnewAfterTheLongestStretch) {
    const GroundTurns turns(moving(similarity(0, 1), 30), 5, 29, 10);
    EXPECT_EQ(turns.at(14).stretch, 5);
    EXPECT_EQ(turns.at(15).stretch, 15);
    EXPECT_EQ(turns.at(29).stretch, 25);
}

}  // namespace eyrie::ground_turns_test
