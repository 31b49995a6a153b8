#include "ground/ground_mosaic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "annotation/scenes.h"
#include "core/error.h"
#include "core/geometry/homography_jacobian.h"
#include "ground/footage_of_view.h"
#include "ground/place_history.h"

namespace eyrie::ground_mosaic_test {
namespace {

constexpr int kLast = 120;

/// A ground with a smooth pattern of its own at every place.
double brightnessOf(cv::Point2d ground) {
    return 128 + 60 * std::sin(ground.x / 17) * std::cos(ground.y / 23) + 40 * std::sin((ground.x + ground.y) / 61);
}

Frame filmed(const std::function<cv::Matx33d(double)>& view, FrameIndex index) {
    Frame frame;
    frame.index = index;
    frame.gray.create(120, 200, CV_8UC1);
    const cv::Matx33d ground_from_image = view(index).inv();
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 200; ++x)
            frame.gray.at<uchar>(y, x) = cv::saturate_cast<uchar>(
                brightnessOf(HomographyJacobian(ground_from_image, cv::Point2d(x, y)).point()));
    return frame;
}

GroundMosaic painted(const std::shared_ptr<const GroundSheets>& sheets, const MosaicOptions& options) {
    GroundMosaic mosaic(sheets, options);
    for (const FrameIndex frame : mosaic.frames()) mosaic.paint(filmed(test::flyingView, frame));
    return mosaic;
}

EventTrack driveAlong(TrackId id, double y, double speed, int first, int last) {
    EventTrack track;
    track.id = id;
    for (int frame = first; frame <= last; ++frame)
        track.boxes.push_back({frame, test::seen({{speed * (frame - first), y}, 10, 5, 0}, test::flyingView(frame))});
    return track;
}

}  // namespace

TEST(GroundMosaic, ShowsTheGroundWhereItIs) {
    const auto sheets = std::make_shared<const GroundSheets>(test::footageOf(test::flyingView, kLast), 0);
    const GroundMosaic mosaic = painted(sheets, {.colour = false});
    EXPECT_LT(mosaic.frames().size(), 40U);
    ASSERT_EQ(mosaic.sheets().size(), 1U);
    const MosaicSheet& sheet = mosaic.sheets().front();
    int looked_at = 0;
    for (int frame = 0; frame <= kLast; frame += 5) {
        for (const cv::Point2d image : {cv::Point2d(30, 30), cv::Point2d(100, 60), cv::Point2d(170, 95)}) {
            const cv::Point2d on_sheet = HomographyJacobian(sheets->sheetFromImage(frame), image).point();
            const cv::Point2d at = sheet.pictureFromSheet(on_sheet);
            const cv::Point pixel(cvRound(at.x), cvRound(at.y));
            ASSERT_EQ(sheet.painted.at<uchar>(pixel), 255) << frame;
            const cv::Point2d middle =
                (cv::Point2d(pixel) + cv::Point2d(0.5, 0.5)) * (1 / sheet.px_per_unit) + sheet.area.tl();
            const cv::Point2d ground = HomographyJacobian(test::flyingView(0).inv(), middle).point();
            EXPECT_NEAR(sheet.picture.at<uchar>(pixel), brightnessOf(ground), 4) << frame;
            ++looked_at;
        }
    }
    EXPECT_GT(looked_at, 60);
}

TEST(GroundMosaic, AllThatWasSeenIsPainted) {
    const auto sheets = std::make_shared<const GroundSheets>(test::footageOf(test::flyingView, kLast), 0);
    const GroundMosaic mosaic = painted(sheets, {.colour = false});
    const MosaicSheet& sheet = mosaic.sheets().front();
    cv::Mat seen = cv::Mat::zeros(sheet.painted.size(), CV_8UC1);
    for (int frame = 0; frame <= kLast; ++frame) {
        std::vector<cv::Point> outline;
        for (const cv::Point2d& corner : sheets->outlineOf(frame)) outline.emplace_back(sheet.pictureFromSheet(corner));
        cv::fillConvexPoly(seen, outline, cv::Scalar(255));
    }
    // Slivers at the borders may be left out.
    EXPECT_LT(cv::countNonZero(seen & ~sheet.painted), 0.04 * cv::countNonZero(seen));
    EXPECT_LT(cv::countNonZero(sheet.painted & ~seen), 0.02 * cv::countNonZero(seen));
}

TEST(GroundMosaic, StaysWithinItsPixelsAndFramesHoweverFarItFlies) {
    const auto view = [](double frame) { return cv::Matx33d(1, 0, -40 * frame, 0, 1, 0, 0, 0, 1); };
    const auto sheets = std::make_shared<const GroundSheets>(test::footageOf(view, 3000, 1500), 0);
    ASSERT_EQ(sheets->count(), 2);
    const GroundMosaic mosaic(sheets, {.max_pixels = 100'000, .wanted_frames = 50});
    std::size_t pixels = 0;
    for (const MosaicSheet& sheet : mosaic.sheets()) pixels += sheet.picture.total();
    EXPECT_LE(pixels, 100'000U);
    EXPECT_GT(pixels, 50'000U);
    EXPECT_LE(mosaic.frames().size(), 50U);
    EXPECT_EQ(mosaic.frames().front(), 0);
    EXPECT_EQ(mosaic.frames().back(), 3000);
}

TEST(GroundMosaic, EverySheetHasItsFirstAndLastFrameHoweverManyThereAre) {
    std::vector<Homography> steps = test::stepsOf(test::flyingView, 100);
    std::erase_if(steps, [](const Homography& step) { return step.to_frame % 5 == 0; });
    Footage footage = test::footageOf(test::flyingView, 100);
    footage.camera = CameraMotion(steps);
    const auto sheets = std::make_shared<const GroundSheets>(footage, 0);
    ASSERT_EQ(sheets->count(), 21);
    const GroundMosaic mosaic(sheets, {.wanted_frames = 10});
    EXPECT_EQ(mosaic.frames().size(), 41U) << "the last sheet is a single frame";
}

TEST(GroundMosaic, RefusesPicturesOfAnotherVideo) {
    const auto sheets = std::make_shared<const GroundSheets>(test::footageOf(test::flyingView, 10), 0);
    GroundMosaic mosaic(sheets);
    Frame other;
    other.index = 3;
    other.gray = cv::Mat::zeros(50, 50, CV_8UC1);
    EXPECT_THROW(mosaic.paint(other), Error);
    other.index = 30;  // of no sheet
    EXPECT_NO_THROW(mosaic.paint(other));
    EXPECT_TRUE(GroundMosaic(std::make_shared<const GroundSheets>()).sheets().empty());
}

TEST(GroundMosaic, AStandingPictureStaysAsItIsInItsColours) {
    const auto standing = [](double) { return cv::Matx33d::eye(); };
    const auto sheets = std::make_shared<const GroundSheets>(test::footageOf(standing, 20), 0);
    GroundMosaic coloured(sheets);
    GroundMosaic grey(sheets, {.colour = false});
    Frame frame = filmed(standing, 0);
    frame.colour.create(frame.gray.size(), CV_8UC3);
    frame.colour.setTo(cv::Scalar(20, 130, 240));
    for (frame.index = 0; frame.index <= 20; ++frame.index) {
        coloured.paint(frame);
        grey.paint(frame);
    }
    EXPECT_EQ(cv::norm(coloured.sheets()[0].picture, frame.colour, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(grey.sheets()[0].picture, frame.gray, cv::NORM_INF), 0);
    // A camera without colours, on a sheet that has them.
    frame.colour.release();
    for (frame.index = 0; frame.index <= 20; ++frame.index) coloured.paint(frame);
    const cv::Vec3b middle = coloured.sheets()[0].picture.at<cv::Vec3b>(60, 100);
    EXPECT_EQ(middle, cv::Vec3b::all(frame.gray.at<uchar>(60, 100)));
}

TEST(GroundMosaic, NoSideIsLongerThanPicturesMayBe) {
    // Left, right, up and down, for more pixels than the limit of 16,000, in sheets that need not be coarse otherwise.
    for (const cv::Point2d way : {cv::Point2d(1, 0), cv::Point2d(-1, 0), cv::Point2d(0, 1), cv::Point2d(0, -1)}) {
        const auto view = [&](double frame) {
            return cv::Matx33d(1, 0, 50 * way.x * frame, 0, 1, 50 * way.y * frame, 0, 0, 1);
        };
        const auto sheets = std::make_shared<const GroundSheets>(test::footageOf(view, 400), 0);
        ASSERT_EQ(sheets->count(), 1);
        const cv::Mat picture =
            GroundMosaic(sheets, {.max_pixels = 1'000'000'000, .colour = false}).sheets()[0].picture;
        EXPECT_LE(std::max(picture.cols, picture.rows), 16'000) << way;
        EXPECT_GE(std::max(picture.cols, picture.rows), 15'990) << way;
    }
}

TEST(PlaceHistory, TellsWhenAPlaceWasSeenAndWhoCrossedIt) {
    const auto view = [](double frame) { return cv::Matx33d(1, 0, -2 * frame, 0, 1, 0, 0, 0, 1); };
    Footage footage = test::footageOf(view, 200);
    const GroundSheets sheets(footage, 0);
    // 150 is in the picture until it has gone left by 150 px.
    const PlaceHistory alone = placeHistory(sheets, {}, 0, {150, 60}, 2);
    EXPECT_EQ(alone.seen, (std::vector<FrameSpan>{{0, 75}}));
    EXPECT_TRUE(alone.passed.empty());
    const PlaceHistory later = placeHistory(sheets, {}, 0, {400, 60}, 2);
    ASSERT_EQ(later.seen.size(), 1U);
    EXPECT_EQ(later.seen.front(), (FrameSpan{101, 200}));
    EXPECT_TRUE(placeHistory(sheets, {}, 1, {150, 60}, 2).seen.empty());
    EXPECT_TRUE(placeHistory(sheets, {}, 0, {150, 160}, 2).seen.empty());
}

TEST(PlaceHistory, WhoCrossesAPlaceIsNamedHoweverFastAndHoweverTheCameraMoves) {
    const GroundSheets sheets(test::footageOf(test::flyingView, 60), 0);
    const cv::Point2d place(60, 100);
    const std::vector<EventTrack> tracks{driveAlong(1, 100, 2, 0, 60),   // over it
                                         driveAlong(2, 130, 2, 0, 60),   // past it
                                         driveAlong(3, 101, 25, 5, 12),  // over it between two frames
                                         driveAlong(4, 100, 1, 0, 20)};  // ends before
    const PlaceHistory history = placeHistory(sheets, tracks, 0, place, 1);
    ASSERT_EQ(history.passed.size(), 2U);
    EXPECT_EQ(history.passed[0].track, 3);
    EXPECT_EQ(history.passed[1].track, 1);
    // 10 long and with 1 to spare: from 54 to 66, at 2 a frame.
    EXPECT_NEAR(history.passed[1].frames.first, 27, 1);
    EXPECT_NEAR(history.passed[1].frames.last, 33, 1);
}

TEST(PlaceHistory, WhoCrossesIsAsWideAsOnTheGroundWhateverTheZoom) {
    const auto view = [](double frame) {
        const double zoom = 1 + 0.0125 * frame;
        return cv::Matx33d(zoom, 0, 0, 0, zoom, 0, 0, 0, 1);
    };
    const GroundSheets sheets(test::footageOf(view, 50), 0);
    const auto crosses = [&](double beside) {
        EventTrack fast{1, {}};  // 10 by 10; at 50 in frame 40 and at 75 in the next
        for (int i = 38; i <= 42; ++i)
            fast.boxes.push_back({i, test::seen({{25.0 * (i - 38), 40 + beside}, 10, 10, 0}, view(i))});
        return !placeHistory(sheets, {fast}, 0, {62.5, 40}, 1).passed.empty();
    };
    EXPECT_TRUE(crosses(5.5));
    EXPECT_FALSE(crosses(6.5));
}

TEST(PlaceHistory, WaysLieOnTheSheet) {
    const GroundSheets sheets(test::footageOf(test::flyingView, 60), 0);
    const auto sheet_paths = pathsOn(sheets, {driveAlong(7, 50, 2, 0, 60)}, 5);
    ASSERT_EQ(sheet_paths.size(), 1U);
    const std::vector<SheetPath>& paths = sheet_paths[0];
    ASSERT_EQ(paths.size(), 1U);
    EXPECT_EQ(paths[0].track, 7);
    EXPECT_EQ(paths[0].points.back().frame, 60);
    EXPECT_LT(paths[0].points.size(), 25U);
    for (const FramePoint& point : paths[0].points) {
        const cv::Point2d ground = HomographyJacobian(test::flyingView(0).inv(), point.at).point();
        EXPECT_NEAR(ground.y, 50, 1e-6);
        EXPECT_NEAR(ground.x, 2 * point.frame, 1e-6);
    }
    // Where the ground begins anew, so do the ways.
    const GroundSheets two(test::footageOf(test::flyingView, 60, 30), 0);
    const auto of_two = pathsOn(two, {driveAlong(7, 50, 2, 0, 60), driveAlong(8, 70, 2, 40, 60)}, 5);
    ASSERT_EQ(of_two.size(), 2U);
    ASSERT_EQ(of_two[0].size(), 1U);
    ASSERT_EQ(of_two[1].size(), 2U);
    EXPECT_EQ(of_two[0][0].points.front().frame, 0);
    EXPECT_EQ(of_two[1][0].track, 7);
    EXPECT_EQ(of_two[1][0].points.front().frame, of_two[0][0].points.back().frame < 30 ? 30 : 31);
    EXPECT_EQ(of_two[1][1].track, 8);
}

}  // namespace eyrie::ground_mosaic_test
