/// Sheets, mosaics, passages and likeness with every number worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>

#include "annotation/scenes.h"
#include "core/geometry/homography_jacobian.h"
#include "events/driven_tracks.h"
#include "ground/followed_pose.h"
#include "ground/footage_of_view.h"
#include "ground/ground_mosaic.h"
#include "ground/place_history.h"
#include "ground/track_likeness.h"
#include "ground/track_story.h"

namespace eyrie::ground_by_hand_test {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

using View = std::function<cv::Matx33d(double)>;

cv::Matx33d still(double) {
    return cv::Matx33d::eye();
}

Frame even(FrameIndex index, int brightness) {
    Frame frame;
    frame.index = index;
    frame.gray = cv::Mat(120, 200, CV_8UC1, cv::Scalar(brightness));
    return frame;
}

EventTrack trackThrough(TrackId id, const std::vector<cv::Point2d>& centres) {
    EventTrack track{id, {}};
    for (const cv::Point2d& centre : centres)
        track.boxes.push_back({static_cast<FrameIndex>(track.boxes.size()), {centre, 10, 6, 0}});
    return track;
}

/// A run of a standing camera at 0.2 m/px: cars of 4.5 × 1.8 m that drive 10 m/s to the right.
test::DrivenTracks carsAt(const std::vector<double>& ys) {
    test::DrivenTracks scene;
    scene.noise_px = 0;
    for (const double y : ys) scene.drive({20, y}, 0, {{12, 36, 36}});
    return scene;
}

TrackLikeness likenessOfSecond(const test::DrivenTracks& scene) {
    StoredTracks run;
    run.tracks = scene.tracks;
    run.footage = scene.footage();
    return tracksLike(run, GroundStretches(run.footage), 1).at(0);
}

}  // namespace

TEST(GroundByHand, FramesThatAreTooUnlikeAreLaidOnANearerOneThatIsHalfAsMuchEnlarged) {
    // Each frame shows the ground smaller by 1.1 and turned by 5 degrees. 1.1⁴ = 1.464 is enlarged enough; from the
    // fifth frame on the fourth carries them, enlarged by its root, 1.21.
    const View view = [](double frame) {
        const double scale = std::pow(1.1, -frame), turn = -radiansFromDegrees(5) * frame;
        const double c = scale * std::cos(turn), s = scale * std::sin(turn);
        return cv::Matx33d(c, -s, 100, s, c, 60, 0, 0, 1);
    };
    const GroundSheets sheets(test::footageOf(view, 9), 0);
    EXPECT_EQ(sheets.count(), 1);
    const cv::Point2d middle(99.5, 59.5);
    const double expected[] = {1,          1.1,         1.21,         1.331,         1.4641,
                               1.21 * 1.1, 1.21 * 1.21, 1.21 * 1.331, 1.21 * 1.4641, 1.331 * 1.1};
    for (int frame = 0; frame < 10; ++frame) {
        const HomographyJacobian local(sheets.sheetFromImage(frame), middle);
        EXPECT_NEAR(local.scale(), expected[frame], 1e-6) << frame;
        EXPECT_NEAR(local.turned(0), radiansFromDegrees(5) * frame, 1e-9) << "it is turned as on the ground";
    }
    // What lies in the middle of the frame that carries stays where it was.
    for (const int carrier : {4, 8}) {
        const cv::Point2d ground = HomographyJacobian(view(carrier).inv(), middle).point();
        const cv::Point2d next = HomographyJacobian(view(carrier + 1), ground).point();
        const cv::Point2d before = HomographyJacobian(sheets.sheetFromImage(carrier), middle).point();
        const cv::Point2d after = HomographyJacobian(sheets.sheetFromImage(carrier + 1), next).point();
        EXPECT_NEAR(after.x, before.x, 1e-6) << carrier;
        EXPECT_NEAR(after.y, before.y, 1e-6) << carrier;
    }
}

TEST(GroundByHand, AMosaicTakesFramesAsTheGroundChanges) {
    // 10 px a frame; 8 % of the diagonal of 233 px are 18.7, half as much again 28.
    const auto sheets = std::make_shared<const GroundSheets>(
        test::footageOf([](double frame) { return cv::Matx33d(1, 0, -10 * frame, 0, 1, 0, 0, 0, 1); }, 20), 0);
    EXPECT_THAT(GroundMosaic(sheets, {.wanted_frames = 11}).frames(),
                ElementsAre(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20));
    EXPECT_THAT(GroundMosaic(sheets, {.wanted_frames = 10}).frames(), ElementsAre(0, 3, 6, 9, 12, 15, 18, 20));
}

TEST(GroundByHand, APictureCountsLessTowardsItsBorder) {
    // Over 6 % of 120 px, 7.2: the first pixel counts 1 / 7.2, the fourth 4 / 7.2, from the eighth on all.
    const auto sheets = std::make_shared<const GroundSheets>(test::footageOf(still, 1), 0);
    GroundMosaic mosaic(sheets, {.colour = false});
    mosaic.paint(even(0, 100));
    const cv::Mat picture = mosaic.sheets()[0].picture;
    EXPECT_EQ(picture.at<uchar>(0, 0), 100) << "over nothing it counts in full";
    mosaic.paint(even(1, 200));
    for (const cv::Point place : {cv::Point(0, 60), cv::Point(199, 60), cv::Point(100, 0), cv::Point(100, 119)})
        EXPECT_NEAR(picture.at<uchar>(place), 100 + 100 / 7.2, 1);
    for (const cv::Point place : {cv::Point(3, 60), cv::Point(196, 60), cv::Point(100, 3), cv::Point(100, 116)})
        EXPECT_NEAR(picture.at<uchar>(place), 100 + 400 / 7.2, 1);
    for (const cv::Point place : {cv::Point(7, 60), cv::Point(192, 60), cv::Point(100, 7), cv::Point(100, 112)})
        EXPECT_EQ(picture.at<uchar>(place), 200);
}

TEST(GroundByHand, AMosaicIsAsCoarseAsItsPixelsAskFor) {
    const auto sheets = std::make_shared<const GroundSheets>(test::footageOf(still, 1), 0);
    GroundMosaic mosaic(sheets, {.max_pixels = 6000, .colour = false});  // a quarter of 24,000
    EXPECT_EQ(mosaic.sheets()[0].picture.size(), cv::Size(100, 60));
    EXPECT_NEAR(mosaic.sheets()[0].px_per_unit, 0.5, 1e-12);
    Frame ramp = even(0, 0);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 200; ++x) ramp.gray.at<uchar>(y, x) = static_cast<uchar>(x + y / 4);
    mosaic.paint(ramp);
    // The pixel (x, y) covers 2 × 2 of the frame, whose middle lies at 2 x + 0.5.
    const cv::Mat picture = mosaic.sheets()[0].picture;
    EXPECT_NEAR(picture.at<uchar>(2, 10), 20.5 + 4 / 4, 1);
    EXPECT_NEAR(picture.at<uchar>(50, 90), 180.5 + 100 / 4, 1);
}

TEST(GroundByHand, OnlyWantedSheetsGetPixels) {
    const auto sheets = std::make_shared<const GroundSheets>(test::footageOf(still, 9, 5), 0);
    ASSERT_EQ(sheets->count(), 2);
    const GroundMosaic mosaic(sheets, {.max_pixels = 24'000, .wanted_sheets = {1}});
    EXPECT_EQ(mosaic.sheets()[0].picture.size(), cv::Size(1, 1));
    EXPECT_EQ(mosaic.sheets()[1].picture.size(), cv::Size(200, 120)) << "all of them are for this one";
    const GroundMosaic both(sheets, {.max_pixels = 12'000});
    EXPECT_EQ(both.sheets()[0].picture.size(), cv::Size(100, 60)) << "a half each way of 48,000";
}

TEST(GroundByHand, WhoComesBackPassesAPlaceTwice) {
    const GroundSheets sheets(test::footageOf(still, 9), 0);
    const EventTrack returning = trackThrough(2, {{60, 60}, {100, 60}, {100, 60}, {60, 60}, {60, 60}});
    const EventTrack also = trackThrough(1, {{62, 60}, {62, 60}});
    const PlaceHistory history = placeHistory(sheets, {returning, also}, 0, {60, 60}, 1);
    // In the frame after it left its way still lies over the place; then it is away for one.
    EXPECT_THAT(history.passed, ElementsAre(Passage{1, {0, 1}}, Passage{2, {0, 1}}, Passage{2, {3, 4}}));
}

TEST(GroundByHand, TheMarginIsMeasuredOnTheSheet) {
    // In frame 40 all is 1.5 times as large. A car reaches from 45 to 55 on the ground, with the margin to 58.
    const View view = [](double frame) {
        const double zoom = 1 + 0.0125 * frame;
        return cv::Matx33d(zoom, 0, 0, 0, zoom, 0, 0, 0, 1);
    };
    const GroundSheets sheets(test::footageOf(view, 50), 0);
    const std::vector<EventTrack> car = {{1, {{40, {{75, 60}, 15, 9, 0}}}}};
    const auto isThere = [&](cv::Point2d place) { return !placeHistory(sheets, car, 0, place, 3).passed.empty(); };
    EXPECT_TRUE(isThere({57.5, 40}));
    EXPECT_FALSE(isThere({58.5, 40}));
    EXPECT_TRUE(isThere({50, 45.5})) << "3 of its width and 3 of the margin";
    EXPECT_FALSE(isThere({50, 46.5}));
}

TEST(GroundByHand, OfPointsNearEachOtherAWayHasOne) {
    const GroundSheets sheets(test::footageOf(still, 9), 0);
    const EventTrack track = trackThrough(3, {{0, 60}, {3, 60}, {5, 60}, {8, 64}, {9, 60}});
    const auto paths = pathsOn(sheets, {track}, 5);
    std::vector<FrameIndex> frames;
    for (const FramePoint& point : paths.at(0).at(0).points) frames.push_back(point.frame);
    EXPECT_THAT(frames, ElementsAre(0, 2, 3, 4)) << "5 further, hypot(3, 4) further, and the last";
}

TEST(GroundByHand, EveryVehicleHasItsOwnWay) {
    const GroundSheets sheets(test::footageOf(still, 9), 0);
    const auto paths = pathsOn(sheets, {trackThrough(3, {{0, 60}, {10, 60}}), trackThrough(5, {{0, 80}, {10, 90}})}, 5);
    ASSERT_THAT(paths.at(0), SizeIs(2));
    for (const std::size_t i : {0U, 1U}) {
        const SheetPath& path = paths[0][i];
        EXPECT_EQ(path.track, i == 0 ? 3 : 5);
        ASSERT_THAT(path.points, SizeIs(2));
        EXPECT_EQ(path.points[0].at, cv::Point2d(0, i == 0 ? 60 : 80));
        EXPECT_EQ(path.points[1].at, cv::Point2d(10, i == 0 ? 60 : 90));
    }
}

TEST(GroundByHand, APlaceIsSeenAgainWhenTheCameraComesBack) {
    // 10 px a frame to the right and back: a place at 95 is in the picture until the frame 9 and from 31 on.
    const View view = [](double frame) {
        return cv::Matx33d(1, 0, -10 * (frame <= 20 ? frame : 40 - frame), 0, 1, 0, 0, 0, 1);
    };
    const GroundSheets sheets(test::footageOf(view, 40), 0);
    EXPECT_THAT(placeHistory(sheets, {}, 0, {95, 60}, 1).seen, ElementsAre(FrameSpan{0, 9}, FrameSpan{31, 40}));
}

TEST(GroundByHand, APlaceFarFromTheAnchorIsFoundInATiltedView) {
    // Seen at an angle from the frame 1 on, and so far away that the anchor's horizon would lie between.
    for (const bool sideways : {true, false}) {
        const View view = [&](double frame) {
            const double k = frame > 0 ? -1e-3 : 0;
            const cv::Matx33d tilt(1, 0, 0, 0, 1, 0, sideways ? 0 : k, sideways ? k : 0, 1);
            return tilt * cv::Matx33d(1, 0, sideways ? -15 * frame : 0, 0, 1, sideways ? 0 : -15 * frame, 0, 0, 1);
        };
        const GroundSheets sheets(test::footageOf(view, 100), 0);
        ASSERT_EQ(sheets.count(), 1);
        const cv::Point2d place = sideways ? cv::Point2d(1540, 30) : cv::Point2d(30, 1540);
        const auto found = sheets.inImage(100, place);
        ASSERT_TRUE(found) << sideways;
        EXPECT_NEAR(sideways ? found->x : found->y, 40 / 0.97, 1e-6);
        EXPECT_NEAR(sideways ? found->y : found->x, 30 / 0.97, 1e-6);
        EXPECT_FALSE(sheets.inImage(0, place));
        const cv::Point2d behind = sideways ? cv::Point2d(1540, 5000) : cv::Point2d(5000, 1540);
        EXPECT_FALSE(sheets.inImage(100, behind));
    }
}

TEST(GroundByHand, AStoryTellsHowFarAVehicleHasDriven) {
    const test::DrivenTracks scene = carsAt({60});
    StoredTracks run;
    run.tracks = scene.tracks;
    run.footage = scene.footage();
    const GroundStretches ground(run.footage);
    const auto story = storyOf(run, ground, 1, 100);
    ASSERT_THAT(story, SizeIs(300));
    EXPECT_EQ(story[0].way_m, 0);
    EXPECT_NEAR(story[1].way_m, 0.4, 1e-6);
    EXPECT_NEAR(story[250].way_m, 100, 1e-6);
    EXPECT_NEAR(story[250].speed, 10, 1e-6);
    EXPECT_NEAR(story[250].length_px, 22.5, 1e-6);
    EXPECT_NEAR(story[250].image.x, 600, 1e-6);
    run.tracks[0].boxes.resize(5);
    for (const StoryPoint& point : storyOf(run, ground, 1, 100)) EXPECT_EQ(point.speed, 0) << "too short to tell";
    EXPECT_THAT(storyOf(run, ground, 1, 100), SizeIs(5));
}

TEST(GroundByHand, AFollowedPoseIsThatOfTheBoxItself) {
    const CameraMotion camera = CameraMotion::standing(0, 50);
    EventTrack track = trackThrough(1, std::vector<cv::Point2d>(20, cv::Point2d(40, 50)));
    track.boxes[7].box.length = 13;
    const auto pose = followedPose(track, 7, camera);
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->length, 13);
    EXPECT_EQ(pose->centre, cv::Point2d(40, 50));
    // Its neighbours on both sides weigh more than it does.
    EventTrack turned = trackThrough(1, {{40, 50}, {40, 50}, {40, 50}});
    turned.boxes[0].box.heading = turned.boxes[2].box.heading = kPi;
    turned.boxes[1].box.heading = 0;
    EXPECT_NEAR(std::abs(followedPose(turned, 1, camera)->heading), kPi, 1e-9) << "12 + 12 against 13";
}

TEST(GroundByHand, SizesAreLikeByTheirProportions) {
    test::DrivenTracks scene = carsAt({60, 60});
    const auto size = [&](double length, double width) {
        test::DrivenTracks other = scene;
        for (TrackedBox& box : other.tracks[1].boxes) box.box.length *= length, box.box.width *= width;
        return likenessOfSecond(other).size;
    };
    EXPECT_NEAR(size(1, 1), 1, 1e-9);
    EXPECT_NEAR(size(1.5, 1), std::exp(-0.5 * std::pow(std::log(1.5) / 0.3, 2)), 1e-9);
    EXPECT_NEAR(size(1, 1.5), size(1.5, 1), 1e-9);
    EXPECT_NEAR(size(1 / 1.5, 1), size(1.5, 1), 1e-9);
    EXPECT_NEAR(size(1.2, 1.3), std::exp(-0.5 * (std::pow(std::log(1.2), 2) + std::pow(std::log(1.3), 2)) / 0.09),
                1e-9);
}

TEST(GroundByHand, ALaneBesideIsLikeBySixTenths) {
    // A lane of 3 m: exp(−½); a metre: exp(−1/18); all of the way is common.
    for (const double beside : {3.0, 1.0}) {
        const TrackLikeness found = likenessOfSecond(carsAt({60, 60 + beside}));
        EXPECT_NEAR(found.path, std::exp(-0.5 * beside * beside / 9), 5e-3) << beside;
        EXPECT_NEAR(found.speed, 1, 1e-6);
        EXPECT_NEAR(found.likeness, std::sqrt(found.path * std::sqrt(found.speed * found.size)), 1e-12);
    }
}

TEST(GroundByHand, SpeedsAreLikeWithAMetreASecondAddedToBoth) {
    test::DrivenTracks scene = carsAt({60});
    scene.drive({20, 60}, 0, {{24, 18, 18}});  // 5 m/s: ln(11 / 6)
    const TrackLikeness found = likenessOfSecond(scene);
    EXPECT_NEAR(found.speed, std::exp(-0.5 * std::pow(std::log(11.0 / 6) / 0.4, 2)), 1e-6);
    EXPECT_NEAR(found.path, 1, 0.005);
}

}  // namespace eyrie::ground_by_hand_test
