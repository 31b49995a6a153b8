#include "scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angle.h"
#include "core/geometry/homography.h"

namespace eyrie::camera_test {
namespace {

CameraPath pathWith(CameraKey key) {
    CameraPath path;
    path.image_size = {640, 480};
    path.keys = {key};
    return path;
}

cv::Point2d throughHomography(const CameraPose& pose, cv::Point2d ground) {
    Homography map;
    map.matrix = pose.imageFromGround();
    return map.apply(ground);
}

}  // namespace

TEST(Camera, fromStraightAboveIsAScaledMap) {
    CameraKey key;
    key.target = {100, 50};
    key.height = 400;
    key.focal_px = 1000;
    const CameraPose pose = pathWith(key).at(0);
    const cv::Point2d centre = pose.project({100, 50, 0});
    EXPECT_NEAR(centre.x, 319.5, 1e-9);
    EXPECT_NEAR(centre.y, 239.5, 1e-9);
    // 0.4 m/px: 10 m to the east are 25 px to the right, 10 m to the south 25 px down.
    EXPECT_NEAR(pose.project({110, 50, 0}).x, 344.5, 1e-9);
    EXPECT_NEAR(pose.project({100, 60, 0}).y, 264.5, 1e-9);
}

TEST(Camera, headingTurnsTheMapAgainstTheCamera) {
    CameraKey key;
    key.heading = kPi / 2;
    key.height = 400;
    key.focal_px = 1000;
    const CameraPose pose = pathWith(key).at(0);
    // Image right is the direction `heading` on the map: south.
    EXPECT_NEAR(pose.project({0, 10, 0}).x, 344.5, 1e-9);
    EXPECT_NEAR(pose.project({0, 10, 0}).y, 239.5, 1e-9);
}

TEST(Camera, tiltLooksTowardsTheTopOfTheImage) {
    CameraKey key;
    key.target = {7, -3};
    key.height = 100;
    key.tilt = radiansFromDegrees(40);
    const CameraPose pose = pathWith(key).at(0);
    EXPECT_NEAR(pose.project({7, -3, 0}).x, 319.5, 1e-9);
    EXPECT_NEAR(pose.project({7, -3, 0}).y, 239.5, 1e-9);
    // The far side is at the top and smaller; things that stand lean upwards.
    EXPECT_LT(pose.project({7, -13, 0}).y, 239.5);
    EXPECT_GT(pose.depth({7, -13, 0}), pose.depth({7, 7, 0}));
    EXPECT_LT(pose.project({7, -3, 10}).y, 239.5 - 20);
}

TEST(Camera, groundHomographyAgreesWithProjection) {
    CameraKey key;
    key.target = {30, 40};
    key.height = 120;
    key.heading = 1.1;
    key.tilt = 0.7;
    CameraPath path = pathWith(key);
    path.shake = {3, 1, 0.01, 4};
    for (const double frame : {0.0, 3.0, 7.5}) {
        const CameraPose pose = path.at(frame);
        for (const cv::Point2d p : {cv::Point2d(30, 40), cv::Point2d(10, 70), cv::Point2d(80, 20)}) {
            const cv::Point2d a = pose.project({p.x, p.y, 0});
            const cv::Point2d b = throughHomography(pose, p);
            EXPECT_NEAR(a.x, b.x, 1e-8);
            EXPECT_NEAR(a.y, b.y, 1e-8);
        }
    }
}

TEST(Camera, roofsMoveAgainstTheGround) {
    CameraPath path;
    path.image_size = {640, 480};
    CameraKey key;
    key.height = 400;
    key.focal_px = 1000;
    path.keys = {key, key};
    path.keys[1].frame = 100;
    path.keys[1].target = {100, 0};
    const auto motion = [&](double z) {
        return path.at(60).project({50, 10, z}).x - path.at(40).project({50, 10, z}).x;
    };
    const double way = path.at(60).position.x - path.at(40).position.x;
    EXPECT_NEAR(motion(0), -way * 1000 / 400, 1e-9);
    // 40 m up, the same way of the camera is seen from 360 m.
    EXPECT_NEAR(motion(40), -way * 1000 / 360, 1e-9);
}

TEST(Camera, shakeIsSmoothAndOfTheGivenSize) {
    CameraKey key;
    CameraPath path = pathWith(key);
    path.shake = {2, 0.4, 0.001, 9};
    double squares = 0;
    constexpr int frames = 2000;
    double largest_jump = 0;
    for (int frame = 0; frame < frames; ++frame) {
        const cv::Point2d p = path.at(frame).project({0, 0, 0}) - cv::Point2d(319.5, 239.5);
        const cv::Point2d q = path.at(frame + 0.01).project({0, 0, 0}) - cv::Point2d(319.5, 239.5);
        squares += p.x * p.x;
        largest_jump = std::max(largest_jump, std::hypot(p.x - q.x, p.y - q.y));
    }
    EXPECT_NEAR(std::sqrt(squares / frames), std::hypot(2, 0.4), 0.7);
    EXPECT_LT(largest_jump, 0.1);
}

TEST(Camera, seesTheGroundItSays) {
    CameraKey key;
    key.height = 400;
    key.focal_px = 1000;
    const cv::Rect2d seen = groundSeen(pathWith(key), 1);
    EXPECT_NEAR(seen.width, 641 * 0.4, 1e-6);
    EXPECT_NEAR(seen.height, 481 * 0.4, 1e-6);
}

TEST(Camera, keysAreJoinedByACubicWithTheSlopesOfTheirNeighbours) {
    CameraPath path;
    path.image_size = {640, 480};
    path.keys.resize(3);
    path.keys[1].frame = 10;
    path.keys[2].frame = 30;
    path.keys[0].height = 100;
    path.keys[1].height = path.keys[2].height = 200;
    const auto heightAt = [&](double frame) { return path.at(frame).position.z; };
    // From 100 with a slope of 10 a frame to 200 with one of 10/3, over 10 frames.
    EXPECT_NEAR(heightAt(5), 0.5 * 100 + 0.125 * 10 * 10 + 0.5 * 200 - 0.125 * 10 * 10 / 3, 1e-9);
    EXPECT_NEAR(heightAt(3), 0.784 * 100 + 0.147 * 10 * 10 + 0.216 * 200 - 0.063 * 10 * 10 / 3, 1e-9);
    // On with that slope to a level end, over 20 frames.
    EXPECT_NEAR(heightAt(20), 200 + 0.125 * 20 * 10 / 3, 1e-9);
    EXPECT_NEAR(heightAt(10), 200, 1e-9);
    EXPECT_EQ(heightAt(-5), 100) << "before the first key it stands";
    EXPECT_EQ(heightAt(99), 200);
}

TEST(Camera, tiltMovesItBackByItsHeight) {
    CameraKey key;
    key.target = {7, -3};
    key.height = 100;
    key.tilt = radiansFromDegrees(45);
    EXPECT_NEAR(pathWith(key).at(0).position.x, 7, 1e-9);
    EXPECT_NEAR(pathWith(key).at(0).position.y, 97, 1e-9) << "south of what it looks at";
    EXPECT_NEAR(pathWith(key).at(0).depth({7, -3, 0}), 100 * std::sqrt(2), 1e-9);
    key.heading = kPi / 2;
    EXPECT_NEAR(pathWith(key).at(0).position.x, 7 - 100, 1e-9) << "image right is south, so the top looks east";
    EXPECT_NEAR(pathWith(key).at(0).position.y, -3, 1e-9);
}

}  // namespace eyrie::camera_test
