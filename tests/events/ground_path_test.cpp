#include "events/ground/ground_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>

#include "core/geometry/angle.h"
#include "events/ground/flow_field.h"

namespace eyrie::ground_path_test {
namespace {

using testing::SizeIs;

Footage standingCamera() {
    Footage footage;
    footage.camera = CameraMotion::standing(0, 1000);
    footage.image_size = {1000, 600};
    footage.last_frame = 1000;
    footage.scale = {0.2, 25, true};
    return footage;
}

/// A track in the frames first … last whose x, px, is given by the frame.
EventTrack trackOf(FrameIndex first, FrameIndex last, const std::function<double(int)>& x) {
    EventTrack track;
    track.id = 1;
    for (FrameIndex frame = first; frame <= last; ++frame) track.boxes.push_back({frame, {{x(frame), 300}, 22, 9, 0}});
    return track;
}

/// One sample by itself, or several.
GroundPath pathOf(const std::vector<GroundSample>& samples) {
    GroundPath path;
    path.measured = true;
    path.samples = samples;
    return path;
}

GroundSample sampleAtPlace(cv::Point2d at, double direction_deg, double speed = 1) {
    GroundSample sample;
    sample.at = at;
    const double direction = radiansFromDegrees(direction_deg);
    sample.velocity = cv::Point2d(std::cos(direction), std::sin(direction)) * speed;
    sample.speed = speed;
    sample.moving = speed > 0;
    return sample;
}

/// One vehicle that passes (0.5, 0.5) m in this direction.
GroundPath passing(double direction_deg) {
    return pathOf({sampleAtPlace({0.5, 0.5}, direction_deg)});
}

}  // namespace

TEST(GroundPath, ThreePicturesTellASpeed) {
    // 10 m/s at one picture a second: the window of the first and of the last sample holds three.
    Footage footage = standingCamera();
    footage.scale.frame_rate_hz = 1;
    const GroundStretches ground(footage);
    for (const FrameIndex last : {2, 3, 10}) {
        const std::vector<EventTrack> tracks = {trackOf(0, last, [](int t) { return 50 * t; })};
        const auto paths = groundPaths(tracks, ground, {});
        ASSERT_THAT(paths, SizeIs(1));
        EXPECT_TRUE(paths[0].measured);
        for (const GroundSample& sample : paths[0].samples) EXPECT_NEAR(sample.speed, 10, 1e-9) << sample.frame;
    }
    const std::vector<EventTrack> two = {trackOf(0, 1, [](int t) { return 50 * t; })};
    EXPECT_FALSE(groundPaths(two, ground, {})[0].measured);
}

TEST(GroundPath, SpeedsAreTheSlopeOfALineThroughASecond) {
    // x = 0.01 t² px. Over t − 12 … t + 12 the line has the slope 0.02 t and lies 0.01 · 52 above the parabola; at the
    // first of 13 samples it has the slope 0.12 and lies 0.01 · 22 below.
    const Footage footage = standingCamera();
    const GroundStretches ground(footage);
    const std::vector<EventTrack> tracks = {trackOf(0, 200, [](int t) { return 0.01 * t * t; })};
    const auto paths = groundPaths(tracks, ground, {});
    ASSERT_THAT(paths, SizeIs(1));
    const GroundPath& path = paths[0];
    ASSERT_THAT(path.samples, SizeIs(201));
    EXPECT_NEAR(path.samples[100].speed, 2 * 0.2 * 25, 1e-9);
    EXPECT_NEAR(path.samples[100].velocity.x, 10, 1e-9);
    EXPECT_NEAR(path.samples[100].velocity.y, 0, 1e-9);
    EXPECT_NEAR(path.samples[100].at.x, (100 + 0.52) * 0.2, 1e-9);
    EXPECT_NEAR(path.samples[100].at.y, 60, 1e-9);
    EXPECT_NEAR(path.samples[50].speed, 5, 1e-9);
    EXPECT_NEAR(path.samples[0].speed, 0.12 * 0.2 * 25, 1e-9);
    EXPECT_NEAR(path.samples[0].at.x, -0.22 * 0.2, 1e-9);
    EXPECT_NEAR(path.samples[200].speed, (4 - 0.12) * 0.2 * 25, 1e-9) << "mirrored at the end";
}

TEST(GroundPath, AStartIsDatedBackToWhereTheLowerSpeedWasPassed) {
    // As above the speed is 0.05 (t + 12) m/s up to t = 12, then 0.1 t: 2.5 km/h are passed at t = 2, 6 km/h at 17.
    const Footage footage = standingCamera();
    const GroundStretches ground(footage);
    const std::vector<EventTrack> tracks = {trackOf(0, 200, [](int t) { return 0.01 * t * t; })};
    EventOptions options;
    options.min_standing_s = 0;
    const auto paths = groundPaths(tracks, ground, options);
    const auto stands = spansOf(paths[0], false);
    ASSERT_THAT(stands, SizeIs(1));
    EXPECT_EQ(stands[0].first, 0U);
    EXPECT_EQ(stands[0].last, 1U);
    const auto moves = spansOf(paths[0], true);
    ASSERT_THAT(moves, SizeIs(1));
    EXPECT_EQ(moves[0].first, 2U);
    EXPECT_EQ(moves[0].last, 200U);
    // A standstill must last as long as it must.
    options.min_standing_s = 0.05;
    const auto longer = groundPaths(tracks, ground, options);
    EXPECT_THAT(spansOf(longer[0], false), SizeIs(0)) << "0.04 s are too short";
    options.min_standing_s = 0.03;
    EXPECT_THAT(spansOf(groundPaths(tracks, ground, options)[0], false), SizeIs(1));
}

TEST(GroundPath, WhatIsTooShortTellsNoSpeed) {
    const Footage footage = standingCamera();
    const GroundStretches ground(footage);
    const auto measured = [&](int frames) {
        const std::vector<EventTrack> tracks = {trackOf(10, 9 + frames, [](int t) { return 100.0 + t; })};
        return groundPaths(tracks, ground, {}).at(0).measured;
    };
    EXPECT_FALSE(measured(13)) << "12 frames from end to end are less than half a second";
    EXPECT_TRUE(measured(14));
    const std::vector<EventTrack> two = {{1, {{10, {{100, 300}, 22, 9, 0}}, {40, {{130, 300}, 22, 9, 0}}}}};
    EXPECT_FALSE(groundPaths(two, ground, {}).at(0).measured) << "two boxes are too few";
    EXPECT_THAT(spansOf(groundPaths(two, ground, {}).at(0), false), SizeIs(0)) << "it neither moves nor stands";
}

TEST(GroundPath, APathEndsWhereTheGroundDoes) {
    Footage footage = standingCamera();
    std::vector<Homography> steps;
    for (int frame = 0; frame < 1000; ++frame)
        if (frame != 99) steps.push_back({cv::Matx33d::eye(), frame, frame + 1});
    footage.camera = CameraMotion(steps);
    const GroundStretches ground(footage);
    const std::vector<EventTrack> tracks = {trackOf(60, 150, [](int t) { return 100.0 + t; })};
    const auto paths = groundPaths(tracks, ground, {});
    ASSERT_THAT(paths, SizeIs(2));
    EXPECT_EQ(paths[0].samples.back().frame, 99);
    EXPECT_TRUE(paths[0].begins);
    EXPECT_FALSE(paths[0].ends);
    EXPECT_EQ(paths[0].stretch, 0);
    EXPECT_EQ(paths[1].samples.front().frame, 100);
    EXPECT_EQ(paths[1].first_box, 40U);
    EXPECT_EQ(paths[1].box(3).frame, 103);
    EXPECT_FALSE(paths[1].begins);
    EXPECT_TRUE(paths[1].ends);
    EXPECT_EQ(paths[1].stretch, 1);
    // Frames that were not searched are left out.
    const std::vector<EventTrack> beyond = {trackOf(990, 1040, [](int t) { return t - 900.0; })};
    const auto kept = groundPaths(beyond, ground, {});
    ASSERT_THAT(kept, SizeIs(1));
    EXPECT_THAT(kept[0].samples, SizeIs(11));
}

TEST(GroundPath, AWayIsThatOfTheMovingSamplesByTheScaleThere) {
    GroundSample a = sampleAtPlace({0, 0}, 0), b = sampleAtPlace({3, 4}, 0), c = sampleAtPlace({3, 5}, 0, 0);
    GroundSample d = sampleAtPlace({3, 8}, 0);
    a.frame = 10, b.frame = 12, c.frame = 15, d.frame = 20;
    b.by_place = 3;
    EXPECT_DOUBLE_EQ(metresBetween(a, b), 10) << "5 m on the ground, 2 m each by the scale in the middle";
    b.by_place = 1;
    const GroundPath path = pathOf({a, b, c, d});
    EXPECT_DOUBLE_EQ(wayBetween(path, 0, 3), 5 + 3) << "what it drifts while it stands does not count";
    EXPECT_DOUBLE_EQ(wayBetween(path, 1, 2), 0);
    EXPECT_DOUBLE_EQ(wayBetween(path, 2, 3), 3);
    EXPECT_DOUBLE_EQ(secondsBetween(path, 0, 3, standingCamera().scale), 0.4);
    EXPECT_EQ(sampleAt(path, 10), 0U);
    EXPECT_EQ(sampleAt(path, 11), 1U);
    EXPECT_EQ(sampleAt(path, 20), 3U);
    EXPECT_EQ(sampleAt(path, 21), 4U);
}

TEST(GroundStretches, ClimbingMakesANewGroundWithTheScaleOfItsFirstFrame) {
    // Every frame shows the ground 1 % smaller about the first pixel: after 111 frames a pixel is three times as wide.
    Footage footage = standingCamera();
    std::vector<Homography> steps;
    for (int frame = 0; frame < 1000; ++frame)
        steps.push_back({cv::Matx33d(1 / 1.01, 0, 0, 0, 1 / 1.01, 0, 0, 0, 1), frame, frame + 1});
    footage.camera = CameraMotion(steps);
    footage.last_frame = 150;
    const GroundStretches ground(footage);
    ASSERT_THAT(ground.all(), SizeIs(2));
    const GroundStretch &low = ground.all()[0], &high = ground.all()[1];
    EXPECT_NEAR(high.first_frame, std::log(3) / std::log(1.01) + 0.5, 1);
    EXPECT_EQ(low.last_frame + 1, high.first_frame);
    EXPECT_NEAR(high.metres_per_px, 0.2 * std::pow(1.01, high.first_frame), 0.01);
    EXPECT_TRUE(low.begins_anew);
    EXPECT_FALSE(low.ends_for_good) << "it was registered all the time";
    EXPECT_FALSE(high.begins_anew);
    EXPECT_TRUE(high.ends_for_good);
    EXPECT_EQ(high.last_frame, 150);
    const double wide = 0.2 * std::pow(1.01, 50);
    EXPECT_NEAR(ground.metresPerPixel(50, {300, 200}), wide, 1e-9);
    EXPECT_NEAR(ground.toGround(50, {300, 200}).x, 300 * wide, 1e-9);
    EXPECT_NEAR(ground.toImage(50, {300 * wide, 200 * wide})->y, 200, 1e-9);
    const OrientedBox box = ground.toGround(50, OrientedBox{{300, 200}, 20, 10, 0.3});
    EXPECT_NEAR(box.length, 20 * wide, 1e-9);
    EXPECT_NEAR(box.width, 10 * wide, 1e-9);
    EXPECT_NEAR(box.heading, 0.3, 1e-9);
    EXPECT_EQ(ground.indexOf(-1), -1);
    EXPECT_EQ(ground.indexOf(150), 1);
    EXPECT_EQ(ground.indexOf(151), -1);
    EXPECT_EQ(ground.of(151), nullptr);
}

TEST(GroundStretches, WhatLiesBehindTheHorizonIsInNoPicture) {
    // A point at (x, y) of the first frame goes to (x, y) / (1 + x / 10,000) in the second: the horizon is at x =
    // −10,000.
    Footage footage = standingCamera();
    footage.camera = CameraMotion({{cv::Matx33d(1, 0, 0, 0, 1, 0, 1e-4, 0, 1), 0, 1}});
    footage.last_frame = 1;
    const GroundStretches ground(footage);
    ASSERT_THAT(ground.all(), SizeIs(1));
    const double metres = footage.scale.gsd_m_per_px;
    EXPECT_FALSE(ground.toImage(1, cv::Point2d(-20'000, 0) * metres));
    EXPECT_FALSE(ground.toImage(1, cv::Point2d(-10'001, 0) * metres));
    EXPECT_TRUE(ground.toImage(1, cv::Point2d(-9'000, 0) * metres));
    const auto above = ground.toImage(1, cv::Point2d(0, -20'000) * metres);
    ASSERT_TRUE(above);
    EXPECT_NEAR(above->y, -20'000, 1e-6);
}

TEST(GroundStretches, TheScaleOfANewGroundIsThatOfTheMiddleOfThePicture) {
    // Each frame the ground is a little smaller, and more so at the bottom: a point at (0, y) goes to y / (1.01 + 1e-6
    // y).
    Footage footage = standingCamera();
    std::vector<Homography> steps;
    steps.reserve(1000);
    for (int frame = 0; frame < 1000; ++frame)
        steps.push_back({cv::Matx33d(1, 0, 0, 0, 1, 0, 0, 1e-6, 1.01), frame, frame + 1});
    footage.camera = CameraMotion(steps);
    footage.last_frame = 150;
    const GroundStretches ground(footage);
    ASSERT_THAT(ground.all(), SizeIs(2));
    const FrameIndex last = ground.all()[0].last_frame;
    EXPECT_NEAR(ground.all()[1].metres_per_px, ground.metresPerPixel(last, {499.5, 299.5}), 1e-9);
    EXPECT_GT(std::abs(ground.metresPerPixel(last, {499.5, 499.5}) - ground.metresPerPixel(last, {499.5, 299.5})),
              1e-4);
}

TEST(GroundStretches, ThePictureReachesHalfAPixelBeyondItsCentres) {
    const Footage footage = standingCamera();
    const GroundStretches ground(footage);
    EXPECT_TRUE(ground.inImage({-0.4, -0.4}));
    EXPECT_FALSE(ground.inImage({-0.6, 300}));
    EXPECT_FALSE(ground.inImage({300, -0.6}));
    EXPECT_TRUE(ground.inImage({999.4, 599.4}));
    EXPECT_FALSE(ground.inImage({999.6, 300}));
    EXPECT_FALSE(ground.inImage({300, 599.6}));
}

TEST(FlowField, ATrackCountsOnceAtEachPlaceWithinTheRadius) {
    // Places are half a radius wide: 13 of them have their middle within 2 m of a middle.
    const FlowField field(2);
    EXPECT_THAT(field.votesOf(passing(0)), SizeIs(13));
    EXPECT_THAT(field.votesOf(pathOf({sampleAtPlace({0.5, 0.5}, 0, 0)})), SizeIs(0)) << "it stands";
    const auto two = [&](double x) {
        return field.votesOf(pathOf({sampleAtPlace({0.5, 0.5}, 0), sampleAtPlace({x, 0.5}, 0)})).size();
    };
    EXPECT_EQ(two(1.4), 13U) << "less than a place further";
    EXPECT_EQ(two(1.5), 18U) << "6 + 2 · 4 + 2 · 2";
    EXPECT_EQ(two(4.5), 33U) << "9 + 2 · 7 + 2 · 5: what lies between is passed, too";
    const GroundPath pausing =
        pathOf({sampleAtPlace({0.5, 0.5}, 0), sampleAtPlace({2.5, 0.5}, 0, 0), sampleAtPlace({4.5, 0.5}, 0)});
    EXPECT_THAT(field.votesOf(pausing), SizeIs(25)) << "9 + 2 · 6 + 2 · 2: nobody knows what lies between";
}

TEST(FlowField, OthersAreCountedByTheirDirection) {
    FlowField field(2);
    const GroundPath own = passing(0);
    field.add(field.votesOf(own));
    // Directions are told by 15 degrees: 52.5 and 67.5 lie on both sides of 60, 112.5 and 127.5 of 120.
    for (const double direction : {50.0, 65.0, 115.0, 130.0, 180.0, -20.0})
        field.add(field.votesOf(passing(direction)));
    const double against = radiansFromDegrees(120);
    const auto others = field.othersAt({0.7, 0.3}, 0, against, field.votesOf(own));
    EXPECT_EQ(others.all, 6) << "but itself";
    EXPECT_EQ(others.along, 2) << "50 and −20";
    EXPECT_EQ(others.against, 2) << "130 and 180";
    EXPECT_EQ(field.othersAt({0.7, 0.3}, 0, against, {}).along, 3);
    EXPECT_EQ(field.othersAt({10.5, 0.5}, 0, against, {}).all, 0) << "nobody came there";
    EXPECT_EQ(field.othersAt({-1.5, 0.5}, 0, against, {}).all, 7) << "2 m from where they passed";
    EXPECT_EQ(field.othersAt({-1.5, -0.5}, 0, against, {}).all, 0) << "hypot(2, 1) is more";
}

TEST(FlowField, ASlowMomentCountsAsMuchAsAFastOne) {
    FlowField field(2);
    // Right at 1 m/s, then down at 10 m/s: where both came near the direction is 45 degrees, not 84.
    field.add(field.votesOf(pathOf({sampleAtPlace({0.5, 0.5}, 0, 1), sampleAtPlace({1.5, 0.5}, 90, 10)})));
    const auto seen = field.othersAt({0.5, 0.5}, radiansFromDegrees(30), radiansFromDegrees(30), {});
    EXPECT_EQ(seen.all, 1);
    EXPECT_EQ(seen.along, 1);
    EXPECT_EQ(seen.against, 0);
}

}  // namespace eyrie::ground_path_test
