#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/parameter.h"
#include "core/state_archive.h"
#include "registration/flight.h"
#include "registration/search/thumbnail_search.h"

namespace eyrie::burned_in_graphics_test {
namespace {

using test::Flight;
using test::kSize;
using test::Watch;

constexpr int kFrames = 60;
const cv::Rect kText(10, 8, 130, 18);
const cv::Rect kClock(190, 212, 120, 18);

/// Draws into the picture of a frame.
using Drawing = std::function<void(cv::Mat&, int frame)>;

void write(cv::Mat& picture, const std::string& text, const cv::Rect& place) {
    cv::putText(picture, text, {place.x, place.br().y - 4}, cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar(250), 1,
                cv::LINE_AA);
}

void drawText(cv::Mat& picture, int) {
    write(picture, "LAT 48.137 N", kText);
}

/// The last four of its figures change in every frame.
void drawClock(cv::Mat& picture, int frame) {
    write(picture, "12:03:" + std::to_string(10 + frame * 7 % 90) + "." + std::to_string(10 + frame * 37 % 90), kClock);
}

/// A car in the middle of the picture that goes away from there by `away` px in every frame.
void drawCar(cv::Mat& picture, cv::Point2d away, int frame) {
    const cv::Point2d at = cv::Point2d(150, 110) + away * frame;
    const cv::Size car(26, 13);
    cv::Mat large(car * 8, CV_8UC1, cv::Scalar(240));
    large(cv::Rect(56, 16, 64, 72)).setTo(50);
    large(cv::Rect(150, 20, 30, 64)).setTo(90);
    cv::Mat shifted;
    const cv::Matx23d whole_from_large(0.125, 0, at.x - 140, 0, 0.125, at.y - 100);
    cv::warpAffine(large, shifted, whole_from_large, {60, 40}, cv::INTER_AREA, cv::BORDER_CONSTANT, cv::Scalar(0));
    cv::Mat covers;
    cv::warpAffine(cv::Mat(large.size(), CV_8UC1, cv::Scalar(255)), covers, whole_from_large, {60, 40},
                   cv::INTER_NEAREST);
    shifted.copyTo(picture(cv::Rect(140, 100, 60, 40)), covers);
}

struct Seen {
    PictureMask graphics;  ///< at last
    double error = 0;      ///< px, mean of the registrations
    int in_place = 0;      ///< corners of the last frame inside `place` …
    int on_graphics = 0;   ///< … and on graphics
};

const cv::Point2d kStep(1.6, 0.7);

cv::Matx33d motionOf(cv::Point2d step) {
    return test::cameraMotion(kSize, step.x, step.y, 0.05, 1);
}

/// What a camera sees that goes on by a step a frame.
std::vector<cv::Mat> picturesOf(cv::Point2d step) {
    Flight flight;
    std::vector<cv::Mat> pictures;
    for (int i = 0; i < kFrames; ++i) {
        pictures.push_back(flight.picture());
        flight.move(motionOf(step));
    }
    return pictures;
}

Seen fly(const Drawing& draw, const cv::Rect& place, cv::Point2d step = kStep,
         const RegistrationOptions& options = {}) {
    static const std::vector<cv::Mat> usual = picturesOf(kStep);
    const std::vector<cv::Mat> pictures = step == kStep ? usual : picturesOf(step);
    Watch watch(options);
    Seen seen;
    const cv::Matx33d motion = motionOf(step);
    RegisteredFrame frame;
    for (int i = 0; i < kFrames; ++i) {
        cv::Mat picture = pictures[std::size_t(i)].clone();
        draw(picture, i);
        frame = watch.seePicture(picture);
        if (i > 0) {
            EXPECT_EQ(frame.registration.state, RegistrationState::registered) << i;
            const double error = test::gridError(frame.registration.current_from_previous.matrix, motion, kSize);
            seen.error += error / (kFrames - 1);
        }
    }
    seen.graphics = frame.graphics;
    for (const Corner& corner : frame.corners) {
        seen.in_place += place.contains(cv::Point(corner.current));
        seen.on_graphics += frame.graphics.marks(corner.current);
    }
    return seen;
}

double shareMarked(const PictureMask& mask, const cv::Rect& place) {
    int marked = 0;
    for (int y = place.y; y < place.br().y; ++y) {
        for (int x = place.x; x < place.br().x; ++x) marked += mask.marks(cv::Point2d(x, y));
    }
    return double(marked) / place.area();
}

}  // namespace

TEST(BurnedInGraphics, TextIsFoundWhileTheGroundMovesOn) {
    const Seen seen = fly(drawText, kText);
    EXPECT_GT(shareMarked(seen.graphics, {14, 12, 96, 10}), 0.8);
    EXPECT_LT(shareMarked(seen.graphics, {0, 0, kSize.width, kSize.height}), 0.1) << "and nothing beside it";
    EXPECT_EQ(shareMarked(seen.graphics, {0, 60, kSize.width, 180}), 0);
    EXPECT_LT(seen.error, 0.05);
    EXPECT_EQ(seen.on_graphics, 0);
}

TEST(BurnedInGraphics, FiguresThatChangeBelongToTheirNeighbours) {
    const Seen seen = fly(drawClock, kClock);
    EXPECT_GT(shareMarked(seen.graphics, {194, 216, 84, 10}), 0.7);
}

TEST(BurnedInGraphics, ACleanPictureHasNone) {
    EXPECT_TRUE(fly([](cv::Mat&, int) {}, kText).graphics.empty());
}

TEST(BurnedInGraphics, ACameraThatHoversTeachesNothing) {
    EXPECT_TRUE(fly(drawText, kText, {0.05, 0}).graphics.empty());
}

/// Edges of the ground that run along the flight stay where they are, too.
TEST(BurnedInGraphics, ALaneBelowTheFlightIsNone) {
    const auto drawLane = [](cv::Mat& picture, int) {
        for (const int x : {120, 126, 180}) cv::line(picture, {x, 0}, {x, kSize.height}, cv::Scalar(250), 2);
    };
    Watch watch;
    Flight flight;
    RegisteredFrame frame;
    for (int i = 0; i < kFrames; ++i) {
        cv::Mat picture = flight.picture();
        drawLane(picture, i);
        frame = watch.seePicture(picture);
        flight.move(test::cameraMotion(kSize, 0, 2, 0, 1));
    }
    EXPECT_TRUE(frame.graphics.empty());
}

/// It stays in the picture while the ground goes on under it, but not to a fraction of a pixel.
TEST(BurnedInGraphics, AVehicleThatDrivesAsTheCameraFliesIsNone) {
    for (const double away : {0.04, 0.1, 0.2}) {
        const auto draw = [&](cv::Mat& picture, int frame) { drawCar(picture, {away, 0}, frame); };
        const Seen seen = fly(draw, {140, 100, 60, 40});
        EXPECT_EQ(shareMarked(seen.graphics, {140, 100, 60, 40}), 0) << away;
        EXPECT_GT(seen.in_place, 3) << away;
    }
}

TEST(BurnedInGraphics, AreGroundWhereTheyAreNotToBeLeftOut) {
    RegistrationOptions options;
    setParameter(describeOf(options), "registration.leave_out_graphics", "false");
    EXPECT_TRUE(fly(drawText, kText, kStep, options).graphics.empty());
}

TEST(BurnedInGraphics, AreKnownAsWellByWhoeverIsTakenUpAgain) {
    Flight flight;
    std::vector<cv::Mat> pictures;
    for (int i = 0; i < 40; ++i) {
        pictures.push_back(flight.picture());
        drawText(pictures.back(), i);
        flight.move(test::cameraMotion(kSize, 1.6, 0.7, 0, 1));
    }
    Registrar whole({}, test::scaleOf(0.3));
    Registrar taken_up({}, test::scaleOf(0.3));
    const auto pictureAt = [&](FrameIndex at) { return pictures[std::size_t(at)]; };
    for (int i = 0; i < 40; ++i) {
        const PictureMask marked = whole.next(test::frameOf(i, pictures[std::size_t(i)])).graphics;
        if (i > 25) {
            const PictureMask again = taken_up.next(test::frameOf(i, pictures[std::size_t(i)])).graphics;
            ASSERT_EQ(again.empty(), marked.empty()) << i;
            EXPECT_EQ(again.cell_px, marked.cell_px);
            if (!marked.empty()) {
                EXPECT_EQ(cv::norm(again.cells, marked.cells, cv::NORM_INF), 0) << i;
            }
        }
        if (i < 25) continue;
        StateWriter writer;
        writer(whole);
        Registrar next({}, test::scaleOf(0.3));
        const std::string bytes = writer.bytes();
        StateReader reader(bytes, pictureAt);
        reader(next);
        reader.end();
        taken_up = std::move(next);
    }
    EXPECT_FALSE(whole.next(test::frameOf(40, pictures[39])).graphics.empty()) << "the scene has some";
}

/// Thermal pictures: the ground is dull and noisy, and what is drawn over it is sharp, so that its corners weigh more.
TEST(BurnedInGraphics, DoNotOutweighADullGroundFromTheFirstFrameOn) {
    Watch watch;
    const test::TexturedGround ground(41, 0.9);
    const cv::Matx33d motion = test::cameraMotion(kSize, 1.9, 0.6, 0, 1);
    cv::Matx33d picture_from_ground = cv::Matx33d::eye();
    for (int i = 0; i < 8; ++i) {
        cv::Mat picture = ground.picture(kSize, picture_from_ground.inv(), 3, static_cast<unsigned>(i) + 1);
        for (int row = 0; row < 4; ++row) write(picture, "HDG 271 SPD 52", {170, 20 + 22 * row, 140, 18});
        const RegisteredFrame frame = watch.seePicture(picture);
        if (i > 0) {
            EXPECT_EQ(frame.registration.state, RegistrationState::registered) << describe(frame.registration.failure);
            EXPECT_LT(test::gridError(frame.registration.current_from_previous.matrix, motion, kSize), 0.3) << i;
        }
        picture_from_ground = motion * picture_from_ground;
    }
}

/// A large thing that both pictures show at one place correlates better than a poor ground.
TEST(BurnedInGraphics, DoNotTellTheCamerasMotionWhenItIsSearchedFor) {
    const cv::Size size(256, 192);
    const cv::Matx33d truth = test::cameraMotion(size, 40, -24, 0);
    const auto seen = [&](const cv::Matx33d& picture_from_ground) {
        cv::Mat picture = test::TexturedGround(51, 0.4).picture(size, picture_from_ground.inv(), 1, 3);
        for (int x = 8; x < 240; x += 32) cv::rectangle(picture, cv::Rect(x, 8, 18, 40), cv::Scalar(255), -1);
        ImagePyramid pyramid;
        pyramid.build(picture);
        return pyramid;
    };
    PictureMask graphics{cv::Mat::zeros(96, 128, CV_8UC1), 2};
    graphics.cells(cv::Rect(0, 0, 128, 28)).setTo(255);
    const ImagePyramid before = seen(cv::Matx33d::eye());
    const ImagePyramid now = seen(truth);
    const auto misled = searchThumbnails(before, now);
    ASSERT_TRUE(misled);
    EXPECT_LT(test::gridError(*misled, cv::Matx33d::eye(), size), 3);
    const auto found = searchThumbnails(before, now, graphics);
    ASSERT_TRUE(found);
    EXPECT_LT(test::gridError(*found, truth, size), 3);
}

TEST(PictureMask, MarksItsCellsAndWhatLiesBesideThePictureAsTheNearestOfThem) {
    PictureMask mask;
    EXPECT_FALSE(mask.marks({3, 3}));
    mask = {cv::Mat::zeros(3, 4, CV_8UC1), 2};
    mask.cells.at<uchar>(0, 3) = 255;
    EXPECT_TRUE(mask.marks({6, 0}));
    EXPECT_TRUE(mask.marks({7.4, 1.4}));
    EXPECT_TRUE(mask.marks({8, -5})) << "an odd last column belongs to the last cells";
    EXPECT_FALSE(mask.marks({5.4, 0}));
    EXPECT_FALSE(mask.marks({7, 1.6}));
}

}  // namespace eyrie::burned_in_graphics_test
