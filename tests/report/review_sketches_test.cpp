#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/driven_events.h"

/// Sketches and pictures of events of vehicles that drive straight on, with every place worked out by hand.
namespace eyrie::review_sketches_test {
namespace {

using testing::HasSubstr;
using testing::Not;

using test::decoded;
using test::drawnAt;
using test::driver;
using test::eventOf;
using test::greyFrame;
using test::inkAt;
using test::inputOf;
using test::placesAlong;

}  // namespace

TEST(PathSketchByHand, AWayFillsTheSketchAndTheEventIsBlue) {
    // On the ground from (50, 100) to (150, 100) m: 1.88 px a metre between edges of 26 px.
    const ReviewReportInput input = inputOf({driver(7, {100, 200}, {2, 0})});
    const ReviewScene scene(input);
    const std::string svg = pathSketch(scene, eventOf({7}, 50, 60, 55, {210, 200}));
    EXPECT_THAT(svg, HasSubstr("width=\"240\" height=\"240\" viewBox=\"0 0 240 240\""));
    EXPECT_THAT(svg, HasSubstr("stroke=\"#9aa7b8\" stroke-width=\"2\" points=\"26,120 27.9,120 "));
    EXPECT_THAT(svg, HasSubstr("212.1,120 214,120 \"/>"));
    EXPECT_THAT(svg, HasSubstr("stroke=\"#2d78c8\" stroke-width=\"3.5\" points=\"120,120 121.9,120 "));
    EXPECT_THAT(svg, HasSubstr(" 138.8,120 \"/><circle cx=\"26\" cy=\"120\" r=\"4\" fill=\"#9aa7b8\"/>"));
    EXPECT_THAT(svg, HasSubstr("fill=\"#9aa7b8\" points=\"223,120 214,124.5 214,115.5\""));
    EXPECT_THAT(svg, HasSubstr("<circle cx=\"129.4\" cy=\"120\" r=\"7\" fill=\"none\" stroke=\"#d64236\""));
    // A quarter of 100 m is 25; 50 is the next round length.
    EXPECT_THAT(svg, HasSubstr("<line x1=\"10\" y1=\"232\" x2=\"104\" y2=\"232\""));
    EXPECT_THAT(svg, HasSubstr("<text x=\"10\" y=\"227\" fill=\"#333333\">50 m</text>"));
    EXPECT_THAT(svg, Not(HasSubstr(">N</text>"))) << "nobody knows where north is";
}

TEST(PathSketchByHand, WithoutAScaleItsBarCountsPixels) {
    const ReviewReportInput input = inputOf({driver(7, {100, 200}, {2, 0})}, 25, false);
    const std::string svg = pathSketch(ReviewScene(input), eventOf({7}, 50, 60, 55, {210, 200}));
    EXPECT_THAT(svg, HasSubstr("<line x1=\"10\" y1=\"232\" x2=\"57\" y2=\"232\""));
    EXPECT_THAT(svg, HasSubstr(">50 px</text>"));
}

TEST(PathSketchByHand, WaysDownwardsAndShortOnesLieInTheMiddle) {
    const ReviewReportInput down = inputOf({driver(8, {300, 100}, {0, 2})});
    const std::string svg = pathSketch(ReviewScene(down), eventOf({8}, 0, 0, 0, {300, 100}));
    EXPECT_THAT(svg, HasSubstr("points=\"120,26 120,27.9 "));
    EXPECT_THAT(svg, HasSubstr("points=\"120,223 115.5,214 124.5,214\""));
    EXPECT_THAT(svg, HasSubstr("<circle cx=\"120\" cy=\"26\" r=\"7\""));
    // 1 m: what is shown is 20 px of the picture, 10 m, wide at least.
    const ReviewReportInput little = inputOf({driver(9, {100, 200}, {0.02, 0})});
    const std::string enlarged = pathSketch(ReviewScene(little), eventOf({9}, 0, 100, 50, {101, 200}));
    EXPECT_THAT(enlarged, HasSubstr("points=\"110.6,120 "));
    EXPECT_THAT(enlarged, HasSubstr("129.4,120 \"/>"));
    EXPECT_THAT(enlarged, HasSubstr("x2=\"104\" y2=\"232\""));
    EXPECT_THAT(enlarged, HasSubstr(">5 m</text>"));
    EXPECT_EQ(pathSketch(ReviewScene(little), eventOf({}, 0, 100, 50, {101, 200})), "");
    EXPECT_EQ(pathSketch(ReviewScene(little), eventOf({77}, 0, 100, 50, {101, 200})), "");
}

TEST(PathSketchByHand, TheWaysOfAllVehiclesShareOneScale) {
    // From (50, 100) and from (50, 150) to the right by 100 m: 50 m apart are 94 px.
    const ReviewReportInput input = inputOf({driver(3, {100, 200}, {2, 0}), driver(4, {100, 300}, {2, 0})});
    const std::string svg = pathSketch(ReviewScene(input), eventOf({3, 4}, 0, 100, 0, {100, 200}));
    EXPECT_THAT(svg, HasSubstr("points=\"26,73 27.9,73 "));
    EXPECT_THAT(svg, HasSubstr("points=\"26,167 27.9,167 "));
    EXPECT_THAT(svg, HasSubstr("<circle cx=\"26\" cy=\"73\" r=\"7\""));
}

TEST(PathSketchByHand, AnArrowPointsNorth) {
    ReviewReportInput input = inputOf({driver(7, {100, 200}, {2, 0})});
    input.places = placesAlong({1, 0}, {0, -1});
    const Event event = eventOf({7}, 50, 60, 55, {210, 200});
    const std::string up = pathSketch(ReviewScene(input), event);
    EXPECT_THAT(up,
                HasSubstr("<line x1=\"218\" y1=\"36\" x2=\"218\" y2=\"17\" stroke=\"#333333\" stroke-width=\"1.5\""));
    EXPECT_THAT(up, HasSubstr("fill=\"#333333\" points=\"218,8 222.5,17 213.5,17\""));
    EXPECT_THAT(up, HasSubstr("<text x=\"194\" y=\"16\" fill=\"#333333\">N</text>"));
    input.places = placesAlong({0, 1}, {1, 0});
    const std::string right = pathSketch(ReviewScene(input), event);
    EXPECT_THAT(right, HasSubstr("<line x1=\"206\" y1=\"24\" x2=\"225\" y2=\"24\""));
    EXPECT_THAT(right, HasSubstr("points=\"234,24 225,28.5 225,19.5\""));
}

TEST(SpeedSketchByHand, TenSecondsBeforeAndAfterAreShown) {
    // Two pictures a second, 1 m a picture: 7.2 km/h; the event lasts from 25 to 30 s.
    const ReviewReportInput input = inputOf({driver(7, {100, 200}, {2, 0})}, 2);
    const std::string svg = speedSketch(ReviewScene(input), eventOf({7}, 50, 60, 55, {210, 200}));
    EXPECT_THAT(svg, HasSubstr("width=\"480\" height=\"240\""));
    // 410 px for 25 s; the axis ends a twentieth above the speed: 200 − 174 / 1.05.
    EXPECT_THAT(svg, HasSubstr("stroke=\"#2d78c8\" points=\"58,34.3 66.2,34.3 "));
    EXPECT_THAT(svg, HasSubstr("459.8,34.3 468,34.3 \"/>"));
    for (const char* label : {">15<", ">40<", ">6<", ">km/h<", ">seconds of the video<", ">7<"})
        EXPECT_THAT(svg, HasSubstr(label));
    EXPECT_THAT(svg, Not(HasSubstr(">10<")));
    EXPECT_THAT(svg, Not(HasSubstr(">45<")));
}

TEST(SpeedSketchByHand, WithoutAScaleSpeedsArePixelsAFrame) {
    const ReviewReportInput input = inputOf({driver(7, {100, 200}, {2, 0})}, 2, false);
    const std::string svg = speedSketch(ReviewScene(input), eventOf({7}, 50, 60, 55, {210, 200}));
    EXPECT_THAT(svg, HasSubstr("points=\"58,34.3 66.2,34.3 "));
    EXPECT_THAT(svg, HasSubstr(">px/frame<"));
    EXPECT_THAT(svg, HasSubstr(">1.5<"));
    EXPECT_THAT(svg, HasSubstr(">2<"));
}

TEST(SpeedSketchByHand, EachVehicleHasItsColourWhileItIsThere) {
    // The second, half as fast, is there from frame 40 to frame 80.
    const ReviewReportInput input = inputOf({driver(3, {100, 200}, {2, 0}), driver(4, {100, 300}, {1, 0}, 80, 40)});
    const std::string svg = speedSketch(ReviewScene(input), eventOf({3, 4}, 50, 60, 55, {210, 200}));
    EXPECT_THAT(svg, HasSubstr("stroke=\"#2d78c8\" points=\"58,34.3 62.1,34.3 "));
    // 4.1 px a frame; half of 165.7 px up.
    EXPECT_THAT(svg, HasSubstr("stroke=\"#2e9650\" points=\"222,117.1 226.1,117.1 "));
    EXPECT_THAT(svg, HasSubstr("386,117.1 \"/>"));
    EXPECT_EQ(speedSketch(ReviewScene(input), eventOf({}, 50, 60, 55, {0, 0})), "");
}

TEST(EventPicturesByHand, AStillShowsTheVehicleAndFiveSecondsOfItsWay) {
    // 960 px for 640; at frame 200 the vehicle is at x = 450, five seconds before it was at 200.
    const ReviewReportInput input = inputOf({driver(7, {50, 200}, {2, 0}, 200)}, 25, true, 200);
    const ReviewScene scene(input);
    const cv::Mat still = decoded(eventStill(scene, eventOf({7}, 200, 200, 200, {450, 200}), greyFrame(200)));
    ASSERT_EQ(still.size(), cv::Size(960, 600));
    EXPECT_TRUE(drawnAt(still, 315, 300)) << "at 210, on its way";
    EXPECT_FALSE(drawnAt(still, 285, 300)) << "at 190, longer ago";
    EXPECT_TRUE(drawnAt(still, 645, 308)) << "its rear, at 430";
    EXPECT_TRUE(drawnAt(still, 705, 300)) << "its front, at 470";
    EXPECT_TRUE(drawnAt(still, 675, 285)) << "its side, at 190";
    EXPECT_FALSE(drawnAt(still, 690, 292)) << "inside, behind the end of the trail";
    EXPECT_FALSE(drawnAt(still, 675, 330));
    // Its number, right of its upper corner; nothing left of it.
    int ink = 0;
    for (int y = 270; y < 290; ++y)
        for (int x = 709; x < 722; ++x) ink += inkAt(still, x, y) ? 1 : 0;
    EXPECT_GT(ink, 10);
}

TEST(EventPicturesByHand, WhatHasNoBoxIsRinged) {
    const ReviewReportInput input = inputOf({driver(7, {50, 200}, {2, 0})});
    const cv::Mat still = decoded(eventStill(ReviewScene(input), eventOf({}, 50, 50, 50, {400, 100}), greyFrame(50)));
    // The middle lies at (600, 150) and a quarter; 14 px around it.
    EXPECT_TRUE(drawnAt(still, 614, 150));
    EXPECT_TRUE(drawnAt(still, 600, 136));
    EXPECT_TRUE(drawnAt(still, 586, 150));
    EXPECT_FALSE(drawnAt(still, 600, 150));
    EXPECT_FALSE(drawnAt(still, 622, 150));
}

TEST(EventPicturesByHand, AStripThatWouldBeThinnerThanAPixelHasOneRow) {
    const ReviewReportInput input = inputOf({driver(7, {50, 200}, {2, 0})});
    Frame strip = greyFrame(50);
    strip.gray = cv::Mat(1, 2500, CV_8UC1, cv::Scalar(120));  // 960 px for 2500: 0.4 px high
    const cv::Mat still = decoded(eventStill(ReviewScene(input), eventOf({7}, 50, 50, 50, {0, 0}), strip));
    EXPECT_EQ(still.size(), cv::Size(960, 1));
}

TEST(EventPicturesByHand, ACloseUpIsFourVehiclesWide) {
    // 40 px of 160: twice as large, with the vehicle in the middle of 320 × 240.
    const ReviewReportInput input = inputOf({driver(7, {100, 200}, {2, 0})});
    Frame frame = greyFrame(50);
    frame.gray(cv::Rect(241, 221, 20, 20)).setTo(250);  // 50 px right of and 30 px below (200, 200)
    const cv::Mat close = decoded(eventCloseUp(ReviewScene(input), eventOf({7}, 50, 50, 50, {200, 200}), frame));
    ASSERT_EQ(close.size(), cv::Size(320, 240));
    EXPECT_TRUE(drawnAt(close, 260, 180)) << "the middle of what is there";
    for (const cv::Point edge : {cv::Point(244, 180), cv::Point(278, 180), cv::Point(260, 164), cv::Point(260, 198)})
        EXPECT_TRUE(drawnAt(close, edge.x, edge.y)) << edge;
    for (const cv::Point beyond : {cv::Point(236, 180), cv::Point(287, 180), cv::Point(260, 156), cv::Point(260, 207)})
        EXPECT_FALSE(drawnAt(close, beyond.x, beyond.y)) << beyond;
    EXPECT_TRUE(drawnAt(close, 200, 128)) << "its front, 20 px from the middle";
    EXPECT_TRUE(drawnAt(close, 160, 140)) << "its side, 10 px from it";
    EXPECT_FALSE(drawnAt(close, 180, 132));

    // Without a box 48 px of height are shown, five times as large; what lies beyond the picture is dark.
    const cv::Mat place = decoded(eventCloseUp(ReviewScene(input), eventOf({}, 50, 50, 50, {0, 0}), greyFrame(50)));
    ASSERT_EQ(place.size(), cv::Size(320, 240));
    EXPECT_NEAR(place.at<cv::Vec3b>(60, 80)[1], 60, 6);
    EXPECT_NEAR(place.at<cv::Vec3b>(180, 150)[1], 60, 6);
    EXPECT_NEAR(place.at<cv::Vec3b>(180, 170)[1], 120, 6);
    EXPECT_NEAR(place.at<cv::Vec3b>(110, 240)[1], 60, 6);
    EXPECT_NEAR(place.at<cv::Vec3b>(130, 240)[1], 120, 6);
}

TEST(ReviewSceneByHand, TheWayNearestInTimeCounts) {
    // In frame 50 nothing connects: two pieces of the same track.
    ReviewReportInput input = inputOf({driver(7, {100, 200}, {2, 0})});
    std::vector<Homography> steps;
    for (int frame = 0; frame < 100; ++frame) {
        if (frame == 49) continue;
        Homography step;
        step.from_frame = frame;
        step.to_frame = frame + 1;
        steps.push_back(step);
    }
    input.reviewed.tracks.footage.camera = CameraMotion(steps);
    const ReviewScene scene(input);
    ASSERT_NE(scene.pathOf(7, 20), nullptr);
    EXPECT_EQ(scene.pathOf(7, 20)->samples.back().frame, 49);
    EXPECT_EQ(scene.pathOf(7, 50)->samples.front().frame, 50);
    EXPECT_EQ(scene.pathOf(7, 300)->samples.front().frame, 50);
    EXPECT_EQ(scene.pathOf(7, -3)->samples.front().frame, 0);
    EXPECT_EQ(scene.pathOf(8, 20), nullptr);
    ASSERT_NE(scene.boxOf(7, 30), nullptr);
    EXPECT_EQ(scene.boxOf(7, 30)->centre, cv::Point2d(160, 200));
    EXPECT_EQ(scene.boxOf(7, 101), nullptr);
    EXPECT_EQ(scene.boxOf(8, 30), nullptr);
}

}  // namespace eyrie::review_sketches_test
