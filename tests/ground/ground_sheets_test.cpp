#include "ground/ground_sheets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "annotation/scenes.h"
#include "core/geometry/homography_jacobian.h"

namespace eyrie::ground_sheets_test {
namespace {

Footage flownOver(const std::function<cv::Matx33d(double)>& view, int last, int broken_at = -1) {
    std::vector<Homography> steps = test::stepsOf(view, last);
    if (broken_at > 0) steps.erase(steps.begin() + broken_at - 1);
    Footage footage;
    footage.camera = CameraMotion(steps);
    footage.image_size = {640, 360};
    footage.last_frame = last;
    return footage;
}

cv::Point2d onSheet(const GroundSheets& sheets, FrameIndex frame, const cv::Matx33d& frame_from_ground,
                    cv::Point2d ground) {
    const cv::Point2d image = HomographyJacobian(frame_from_ground, ground).point();
    return HomographyJacobian(sheets.sheetFromImage(frame), image).point();
}

double distance(cv::Point2d a, cv::Point2d b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

TEST(GroundSheets, WhatStandsOnTheGroundStandsStillAsTheAnchorShowsIt) {
    const Footage footage = flownOver(test::flyingView, 150);
    for (const FrameIndex anchor : {0, 70, 150}) {
        const GroundSheets sheets(footage, anchor);
        EXPECT_EQ(sheets.count(), 1);
        EXPECT_EQ(sheets.anchor(), anchor);
        for (const cv::Point2d ground : {cv::Point2d(10, 20), cv::Point2d(300, 200)}) {
            const cv::Point2d as_in_anchor = HomographyJacobian(test::flyingView(anchor), ground).point();
            for (int frame = 0; frame <= 150; frame += 10)
                EXPECT_LT(distance(onSheet(sheets, frame, test::flyingView(frame), ground), as_in_anchor), 1e-6);
        }
    }
}

TEST(GroundSheets, RotationAndZoomStaySteadyOverAFlightThatNoPlaneHolds) {
    // Tilted views that differ in their perspective more and more: no frame can be laid on one far away.
    const auto view = [](double frame) {
        const double turn = frame / 150;
        const cv::Matx33d tilt{1, 0, 0, 0, 1, 0, 0, 3e-4, 1};
        const cv::Matx33d fly{
            std::cos(turn), -std::sin(turn), 6 * frame, std::sin(turn), std::cos(turn), 4 * frame, 0, 0, 1};
        return tilt * fly;
    };
    const GroundSheets sheets(flownOver(view, 600), 0);
    EXPECT_EQ(sheets.count(), 1);
    cv::Point2d before(0, 0);
    cv::Point2d over(0, 0);
    cv::Point2d ground_before(0, 0);
    int leaps = 0;
    for (int frame = 0; frame <= 600; ++frame) {
        // What lies in the middle of the picture: its direction and size on the sheet change by little from frame to
        // frame, though the camera turns by 4 radians; by more only where frames are laid on another one.
        const cv::Point2d middle(320, 180);
        const HomographyJacobian to_ground(view(frame).inv(), middle);
        const cv::Point2d seen = HomographyJacobian(view(frame), to_ground.point()).vector({0, -1});
        const cv::Point2d north = HomographyJacobian(sheets.sheetFromImage(frame), middle).vector(seen);
        const double leap = frame == 0 ? 0 : distance(north, before);
        EXPECT_LT(leap, 0.4) << frame;
        leaps += leap > 0.02 ? 1 : 0;
        EXPECT_LT(std::abs(std::atan2(north.x, -north.y)), 0.5) << frame;
        EXPECT_GT(distance(north, {0, 0}), 0.4) << frame;
        EXPECT_LT(distance(north, {0, 0}), 1.6) << frame;
        before = north;
        // Nor does it leap aside: it goes on by about as much as the camera did over the ground.
        const cv::Point2d there = HomographyJacobian(sheets.sheetFromImage(frame), middle).point();
        const double flown = distance(to_ground.point(), ground_before);
        EXPECT_LT(frame == 0 ? 0 : distance(there, over), 2 * flown) << frame;
        ground_before = to_ground.point();
        over = there;
    }
    EXPECT_LE(leaps, 8);
}

TEST(GroundSheets, WhereNothingConnectsTwoFramesASheetBeginsAsFilmed) {
    const GroundSheets sheets(flownOver(test::flyingView, 100, 40), 60);
    EXPECT_EQ(sheets.count(), 2);
    EXPECT_EQ(sheets.sheetOf(39), 0);
    EXPECT_EQ(sheets.sheetOf(40), 1);
    EXPECT_EQ(sheets.sheetOf(100), 1);
    EXPECT_EQ(sheets.sheetFromImage(39), cv::Matx33d::eye());
    EXPECT_EQ(sheets.sheetFromImage(60), cv::Matx33d::eye());
    const cv::Point2d ground(100, 100);
    EXPECT_LT(distance(onSheet(sheets, 5, test::flyingView(5), ground),
                       HomographyJacobian(test::flyingView(39), ground).point()),
              1e-6);
}

TEST(GroundSheets, APlaceIsFoundInTheFramesThatShowIt) {
    const auto view = [](double frame) { return cv::Matx33d(1, 0, -10 * frame, 0, 1, 0, 0, 0, 1); };
    const GroundSheets sheets(flownOver(view, 200), 0);
    EXPECT_EQ(sheets.inImage(0, {100, 50}), cv::Point2d(100, 50));
    EXPECT_LT(distance(sheets.inImage(10, {100, 50}).value(), {0, 50}), 1e-9);
    EXPECT_FALSE(sheets.inImage(11, {100, 50}));
    EXPECT_TRUE(sheets.inImage(11, {740, 50}));
    EXPECT_FALSE(sheets.inImage(0, {100, 360}));
    EXPECT_FALSE(sheets.inImage(201, {2100, 50}));
    EXPECT_LT(distance(sheets.outlineOf(10)[2], {739.5, 359.5}), 1e-9);
}

TEST(GroundSheets, WithoutFramesNothingIsMoved) {
    const GroundSheets none;
    EXPECT_EQ(none.count(), 0);
    EXPECT_EQ(none.sheetOf(0), -1);
    EXPECT_EQ(none.sheetFromImage(3), cv::Matx33d::eye());
    Footage empty;
    empty.first_frame = 5;
    empty.last_frame = 4;
    EXPECT_EQ(GroundSheets(empty, 9).count(), 0);
    EXPECT_EQ(GroundSheets(flownOver(test::flyingView, 10), 99).anchor(), 10);
    EXPECT_EQ(GroundSheets(flownOver(test::flyingView, 0), 0).count(), 1) << "a single frame has one";
}

}  // namespace eyrie::ground_sheets_test
