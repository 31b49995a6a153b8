#include "ground/ground_measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "annotation/scenes.h"
#include "core/geometry/homography_jacobian.h"
#include "ground/followed_pose.h"

namespace eyrie::ground_measure_test {
namespace {

Footage flight(int last, int broken_at = -1) {
    std::vector<Homography> steps = test::stepsOf(test::flyingView, last);
    if (broken_at > 0) steps.erase(steps.begin() + broken_at - 1);
    Footage footage;
    footage.camera = CameraMotion(steps);
    footage.image_size = {640, 360};
    footage.last_frame = last;
    footage.scale.gsd_m_per_px = 0.2;
    return footage;
}

FramePoint seenIn(FrameIndex frame, cv::Point2d ground) {
    return {frame, HomographyJacobian(test::flyingView(frame), ground).point()};
}

/// Drives straight with noise in its headings.
EventTrack drive(int last) {
    EventTrack track;
    for (int frame = 0; frame <= last; ++frame) {
        const double heading = 0.3 + (frame % 2 == 0 ? 0.2 : -0.2);
        track.boxes.push_back({frame, test::seen({{100.0 + 2 * frame, 60}, 20, 9, heading}, test::flyingView(frame))});
    }
    return track;
}

}  // namespace

TEST(GroundMeasure, DistancesAreThoseOfTheGroundHoweverTheCameraMoves) {
    const Footage footage = flight(100);
    const GroundStretches ground(footage);
    // 30 by 40 px of the first frame, which is as the ground is: 50 px at 0.2 m.
    const auto same_frame = measureBetween(ground, seenIn(80, {50, 60}), seenIn(80, {80, 100}));
    const auto across = measureBetween(ground, seenIn(10, {50, 60}), seenIn(80, {80, 100}));
    ASSERT_TRUE(same_frame && across);
    EXPECT_NEAR(same_frame->metres, 10, 1e-6);
    EXPECT_NEAR(across->metres, 10, 1e-6);
    const double enlarged = HomographyJacobian(test::flyingView(80), {50, 60}).scale();
    EXPECT_NEAR(same_frame->px, 50 * enlarged, 1e-6);
    EXPECT_NEAR(across->px, 50 * enlarged, 1e-6);
}

TEST(GroundMeasure, InAnObliqueViewAWayIsAsLongAsTheScaleOfItsPlaceSays) {
    SceneScale scale{0.2, 25, true, ScaleSlope::ofPicture({641, 361}, 0, 0.005)};
    // 100 px below the middle there are 1.5 times as many pixels to a metre, above it half as many.
    EXPECT_NEAR(measureInFrame(scale, {290, 280}, {350, 280}).metres, 60 * 0.2 / 1.5, 1e-9);
    EXPECT_NEAR(measureInFrame(scale, {290, 80}, {350, 80}).metres, 60 * 0.2 / 0.5, 1e-9);
    EXPECT_NEAR(measureInFrame(scale, {320, 80}, {320, 280}).metres, 200 * 0.2, 1e-9);
    EXPECT_NEAR(measureInFrame(scale, {290, 80}, {350, 80}).px, 60, 1e-9);
}

TEST(GroundMeasure, AcrossFramesOfAnObliqueViewTheScaleIsThatOfThePlaceTo) {
    Footage footage = flight(20);
    footage.scale.slope = ScaleSlope::ofPicture({641, 361}, 0, 0.005);
    const GroundStretches ground(footage);
    for (const cv::Point2d place : {cv::Point2d(300, 90), cv::Point2d(300, 250)}) {
        const FramePoint to{20, place};
        const auto from = carriedTo(ground, {20, place + cv::Point2d(40, 0)}, 3);
        ASSERT_TRUE(from);
        const auto measure = measureBetween(ground, *from, to);
        ASSERT_TRUE(measure);
        EXPECT_NEAR(measure->px, 40, 1e-6);
        EXPECT_NEAR(measure->metres, 40 * 0.2 / (1 + 0.005 * (place.y - 180)), 1e-6);
    }
}

TEST(GroundMeasure, NothingIsMeasuredAcrossFramesThatNothingConnects) {
    const Footage footage = flight(100, 50);
    const GroundStretches ground(footage);
    EXPECT_FALSE(measureBetween(ground, seenIn(10, {50, 60}), seenIn(80, {80, 100})));
    EXPECT_FALSE(measureBetween(ground, seenIn(10, {50, 60}), {900, {0, 0}}));
    EXPECT_FALSE(carriedTo(ground, {900, {0, 0}}, 900));
    EXPECT_TRUE(measureBetween(ground, seenIn(60, {50, 60}), seenIn(80, {80, 100})));
}

TEST(GroundMeasure, APlaceIsCarriedWithTheGround) {
    const Footage footage = flight(60);
    const GroundStretches ground(footage);
    const auto there = carriedTo(ground, seenIn(5, {70, 80}), 60);
    ASSERT_TRUE(there);
    EXPECT_EQ(there->frame, 60);
    EXPECT_NEAR(cv::norm(there->at - seenIn(60, {70, 80}).at), 0, 1e-6);
}

TEST(FollowedPose, HeadingsAreSteadyThoughBoxesSwayAndTheCameraTurns) {
    const CameraMotion camera(test::stepsOf(test::flyingView, 100));
    const EventTrack track = drive(100);
    for (int frame = 15; frame <= 85; ++frame) {
        const auto pose = followedPose(track, frame, camera);
        ASSERT_TRUE(pose);
        const HomographyJacobian view(test::flyingView(frame), {100.0 + 2 * frame, 60});
        EXPECT_NEAR(std::remainder(pose->heading - view.turned(0.3), 2 * CV_PI), 0, 0.02) << frame;
        EXPECT_NEAR(cv::norm(pose->centre - view.point()), 0, 1e-9);
    }
}

TEST(FollowedPose, BoxesCountLessTheFartherTheyAreInTime) {
    const auto still = [](double) { return cv::Matx33d::eye(); };
    const CameraMotion camera(test::stepsOf(still, 60));
    // All of them head along x but one; weights fall from 13 by one a frame.
    const auto headingWith = [&](int other) {
        EventTrack track;
        for (int frame = 0; frame <= 60; ++frame)
            track.boxes.push_back({frame, {{100, 60}, 20, 9, frame == other ? CV_PI / 2 : 0}});
        return followedPose(track, 30, camera).value().heading;
    };
    constexpr double kAll = 13 * 13;
    EXPECT_NEAR(headingWith(30), std::atan2(13, kAll - 13), 1e-9);
    for (const int side : {-1, 1}) {
        EXPECT_NEAR(headingWith(30 + side), std::atan2(12, kAll - 12), 1e-9);
        EXPECT_NEAR(headingWith(30 + 12 * side), std::atan2(1, kAll - 1), 1e-9);
        EXPECT_NEAR(headingWith(30 + 13 * side), 0, 1e-9);
    }
}

TEST(FollowedPose, OnlyFramesOfTheTrackHaveOne) {
    const CameraMotion camera(test::stepsOf(test::flyingView, 100));
    EventTrack track = drive(20);
    track.boxes.erase(track.boxes.begin() + 10);
    EXPECT_FALSE(followedPose(track, 10, camera));
    EXPECT_FALSE(followedPose(track, 21, camera));
    EXPECT_TRUE(followedPose(track, 20, camera));
    // Where nothing is known of the camera the box itself tells.
    const auto pose = followedPose(track, 5, CameraMotion());
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->heading, track.boxes[5].box.heading, 1e-9);
}

}  // namespace eyrie::ground_measure_test
