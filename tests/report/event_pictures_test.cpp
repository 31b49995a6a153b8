#include <gtest/gtest.h>

#include "report/driven_events.h"

/// Where stills, close-ups and pictures of the ground show things, to the pixel.
namespace eyrie::event_pictures_test {
namespace {

using test::decoded;
using test::drawnAt;
using test::driver;
using test::eventOf;
using test::greyFrame;
using test::inkAt;
using test::inputOf;

/// Pictures all alike.
class SameVideo : public FrameSource {
 public:
    explicit SameVideo(cv::Size size = test::kVideo, int frames = 1000) {
        info_.size = size;
        info_.frame_count = frames;
    }
    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool) override {
        Frame frame;
        frame.index = index;
        frame.gray = cv::Mat(info_.size, CV_8UC1, cv::Scalar(120));
        return frame;
    }
    std::int64_t timeOf(FrameIndex index) const override { return index * 40'000LL; }

 private:
    VideoInfo info_;
};

/// How much of the colours of trail (green), way of an event (blue) or ring (red) there is at a pixel.
int greenAt(const cv::Mat& picture, int x, int y) {
    const cv::Vec3b& pixel = picture.at<cv::Vec3b>(y, x);
    return pixel[1] - std::max(pixel[0], pixel[2]);
}
int blueAt(const cv::Mat& picture, int x, int y) {
    const cv::Vec3b& pixel = picture.at<cv::Vec3b>(y, x);
    return pixel[0] - pixel[2];
}
int redAt(const cv::Mat& picture, int x, int y) {
    const cv::Vec3b& pixel = picture.at<cv::Vec3b>(y, x);
    return pixel[2] - std::max(pixel[0], pixel[1]);
}

/// Where a bright thing on grey begins and ends along a row or column.
cv::Range brightIn(const cv::Mat& picture, int at, bool in_row) {
    int first = -1, last = -1;
    const int length = in_row ? picture.cols : picture.rows;
    for (int i = 0; i < length; ++i) {
        const cv::Vec3b& pixel = in_row ? picture.at<cv::Vec3b>(at, i) : picture.at<cv::Vec3b>(i, at);
        if (pixel[1] < 185) continue;
        if (first < 0) first = i;
        last = i;
    }
    return {first, last};
}

/// How far from a middle the red of its ring lies in a direction, px; 0 without any.
double ringRadius(const cv::Mat& picture, cv::Point middle, cv::Point towards) {
    double sum = 0, weighted = 0;
    for (int r = 3; r <= 16; ++r) {
        const int red = std::max(0, redAt(picture, middle.x + r * towards.x, middle.y + r * towards.y) - 20);
        sum += red;
        weighted += static_cast<double>(red) * r;
    }
    return sum > 0 ? weighted / sum : 0;
}

int redIn(const cv::Mat& picture, cv::Rect area) {
    int count = 0;
    for (int y = area.y; y < area.br().y; ++y)
        for (int x = area.x; x < area.br().x; ++x) count += redAt(picture, x, y) > 40 ? 1 : 0;
    return count;
}

/// The pictures of the ground in the order of the chapter, and how many events have none.
struct Ground {
    std::vector<std::string> names;
    std::vector<cv::Mat> pictures;
    std::size_t left_out = 0;
};
Ground groundOf(ReviewReportInput input, std::vector<Event> events, SameVideo video = SameVideo()) {
    input.reviewed.events = std::move(events);
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < input.reviewed.events.size(); ++i) all.push_back(i);
    ReportFile report;
    const GroundChapter chapter = addGround(ReviewScene(input), all, video, report, {}, {});
    Ground ground{chapter.pictures, {}, chapter.left_out};
    for (const std::string& name : chapter.pictures) ground.pictures.push_back(decoded(report.pictures.at(name).bytes));
    return ground;
}

/// Pixel of the video on the ground that a standing camera sees, 640 px enlarged to 1200.
cv::Point onGround(cv::Point2d video) {
    return {cvRound((video.x + 0.5) * 1.875 - 0.5), cvRound((video.y + 0.5) * 1.875 - 0.5)};
}

}  // namespace

TEST(StillPixels, ATrailEndsInTheMiddleOfItsVehicle) {
    // 30 px a frame, so that the last step begins behind the vehicle; 1.5 times as large.
    const ReviewReportInput input = inputOf({driver(7, {50, 200}, {30, 0}, 15)});
    const cv::Mat still = decoded(eventStill(ReviewScene(input), eventOf({7}, 12, 12, 12, {410, 200}), greyFrame(12)));
    EXPECT_GT(greenAt(still, cvRound(403 * 1.5), 300), 40) << "within the vehicle, before its middle at 410";
    EXPECT_GT(greenAt(still, cvRound(60 * 1.5), 300), 40) << "where it began, at 50";
    EXPECT_LT(greenAt(still, cvRound(418 * 1.5), 300), 20) << "beyond its middle";
    EXPECT_LT(greenAt(still, cvRound(40 * 1.5), 300), 20);
    EXPECT_FALSE(inkAt(still, cvRound(300 * 1.5), 306)) << "beside it";
    EXPECT_FALSE(inkAt(still, cvRound(300 * 1.5), 294));
}

TEST(StillPixels, ATrailLiesOnTheGroundAsTheFrameShowsIt) {
    // The ground comes down by 2 px a frame, and the vehicle with it.
    ReviewReportInput input = inputOf({driver(7, {50, 100}, {10, 2}, 30)});
    std::vector<Homography> steps;
    for (int frame = 0; frame < 30; ++frame) {
        Homography step;
        step.from_frame = frame;
        step.to_frame = frame + 1;
        step.matrix(1, 2) = 2;
        steps.push_back(step);
    }
    input.reviewed.tracks.footage.camera = CameraMotion(steps);
    input.reviewed.tracks.footage.last_frame = 30;
    const cv::Mat still = decoded(eventStill(ReviewScene(input), eventOf({7}, 30, 30, 30, {350, 160}), greyFrame(30)));
    EXPECT_TRUE(drawnAt(still, 200 * 3 / 2, 160 * 3 / 2));
    EXPECT_TRUE(drawnAt(still, 60 * 3 / 2, 160 * 3 / 2)) << "level from its beginning on";
    EXPECT_FALSE(drawnAt(still, 200 * 3 / 2, 130 * 3 / 2));
}

TEST(StillPixels, EveryVehicleOfTheEventIsOutlinedAndNoOther) {
    const ReviewReportInput input =
        inputOf({driver(3, {100, 100}, {0, 0}), driver(4, {300, 200}, {0, 0}), driver(5, {500, 300}, {0, 0})});
    const cv::Mat still =
        decoded(eventStill(ReviewScene(input), eventOf({3, 5}, 50, 50, 50, {100, 100}), greyFrame(50)));
    EXPECT_TRUE(drawnAt(still, 120, 150));
    EXPECT_TRUE(drawnAt(still, 720, 450));
    EXPECT_FALSE(drawnAt(still, 420, 300));
    EXPECT_FALSE(drawnAt(still, 171, 150)) << "no ring where there is a box";
    // Where the vehicle has no box in the frame, there is a ring.
    const ReviewReportInput gone = inputOf({driver(3, {100, 100}, {0, 0}, 40)});
    const cv::Mat place = decoded(eventStill(ReviewScene(gone), eventOf({3}, 50, 50, 50, {400, 200}), greyFrame(50)));
    EXPECT_TRUE(drawnAt(place, 614, 300));
    EXPECT_TRUE(drawnAt(place, 600, 314));
    EXPECT_FALSE(drawnAt(place, 600, 300));
}

TEST(CloseUpPixels, APlaceWithoutABoxIsShownFiveTimesAsLargeInTheMiddle) {
    // 64 × 48 px around the middle of pixel (200, 100), which begins a patch of 8 px.
    const ReviewReportInput input = inputOf({});
    Frame frame = greyFrame(50);
    frame.gray(cv::Rect(200, 100, 8, 8)).setTo(250);
    const cv::Mat close = decoded(eventCloseUp(ReviewScene(input), eventOf({}, 50, 50, 50, {200, 100}), frame));
    ASSERT_EQ(close.size(), cv::Size(320, 240));
    for (const bool across : {true, false}) {
        const cv::Range bright = brightIn(close, across ? 140 : 180, across);
        EXPECT_NEAR(bright.start, across ? 157.5 : 117.5, 1) << across;
        EXPECT_NEAR(bright.end, across ? 196.5 : 156.5, 1) << across;
    }
}

TEST(CloseUpPixels, ABoxLiesOnItsVehicle) {
    // 80 px around 20: four times as large.
    ReviewReportInput input = inputOf({driver(7, {203.5, 102.5}, {0, 0})});
    for (TrackedBox& box : input.reviewed.tracks.tracks[0].boxes) box.box = {{203.5, 102.5}, 20, 14, 0};
    Frame frame = greyFrame(50);
    frame.gray(cv::Rect(198, 100, 12, 6)).setTo(250);  // pixels 198 … 209 and 100 … 105
    const ReviewScene scene(input);
    const cv::Mat close = decoded(eventCloseUp(scene, eventOf({7}, 50, 50, 50, {0, 0}), frame));
    ASSERT_EQ(close.size(), cv::Size(320, 240));
    const cv::Range across = brightIn(close, 120, true), down = brightIn(close, 150, false);
    EXPECT_NEAR(across.end - across.start + 1, 12 * 4, 2);
    EXPECT_NEAR(down.end - down.start + 1, 6 * 4, 2);
    const cv::Point middle((across.start + across.end) / 2, (down.start + down.end) / 2);
    EXPECT_NEAR(middle.x, 159.5, 1);
    EXPECT_NEAR(middle.y, 119.5, 1);
    for (const cv::Point side : {cv::Point(-40, 0), cv::Point(40, 0), cv::Point(0, -28), cv::Point(0, 28)})
        EXPECT_TRUE(inkAt(close, middle.x + side.x, middle.y + side.y)) << side;
    for (const cv::Point bare : {cv::Point(-46, 0), cv::Point(-34, 0), cv::Point(34, 0), cv::Point(46, 10),
                                 cv::Point(0, -34), cv::Point(0, 34), cv::Point(0, -22), cv::Point(0, 22)})
        EXPECT_FALSE(drawnAt(close, middle.x + bare.x, middle.y + bare.y)) << bare;
}

TEST(GroundPixels, ARingLiesAroundThePlaceOfItsEventAndItsNumberRightOfIt) {
    const Ground ground = groundOf(inputOf({}), {eventOf({}, 50, 50, 50, {300, 196})});
    ASSERT_EQ(ground.pictures.size(), 1U);
    EXPECT_EQ(ground.names[0], "ground-1");
    EXPECT_EQ(ground.left_out, 0U);
    const cv::Mat& picture = ground.pictures[0];
    ASSERT_EQ(picture.size(), cv::Size(1200, 750));
    const cv::Point middle = onGround({300, 196});  // (562.94, 367.94)
    for (const cv::Point towards : {cv::Point(-1, 0), cv::Point(0, -1), cv::Point(0, 1)})
        EXPECT_NEAR(ringRadius(picture, middle, towards), 9, 0.6) << towards;
    EXPECT_FALSE(inkAt(picture, middle.x, middle.y));
    EXPECT_GT(redIn(picture, {middle.x + 12, middle.y - 7, 10, 14}), 8) << "its number";
    EXPECT_EQ(redIn(picture, {middle.x + 26, middle.y - 20, 60, 40}), 0);
    EXPECT_EQ(redIn(picture, {middle.x - 40, middle.y - 40, 26, 80}), 0);
}

TEST(GroundPixels, NumbersStayInThePictureAndEventsOnEachOtherShareOne) {
    // At the border; two of which the second lies 4 px from the first, 7.5 in the picture; two that are 8 px apart.
    const Ground ground =
        groundOf(inputOf({}), {eventOf({}, 50, 50, 50, {634, 100}), eventOf({}, 50, 50, 50, {100, 100}),
                               eventOf({}, 60, 60, 60, {100, 104}), eventOf({}, 50, 50, 50, {100, 300}),
                               eventOf({}, 60, 60, 60, {100, 308})});
    ASSERT_EQ(ground.pictures.size(), 1U);
    const cv::Mat& picture = ground.pictures[0];
    const cv::Point border = onGround({634, 100}), shared = onGround({100, 100}), apart = onGround({100, 300});
    EXPECT_GT(redIn(picture, {1188, border.y - 7, 10, 14}), 8);
    EXPECT_GT(redIn(picture, {shared.x + 32, shared.y - 8, 16, 18}), 8) << "2, 3";
    EXPECT_EQ(redIn(picture, {apart.x + 30, apart.y - 8, 30, 40}), 0) << "4 and below it 5";
    EXPECT_GT(redIn(picture, {apart.x + 12, apart.y + 9, 12, 14}), 8);
}

TEST(GroundPixels, WaysAreThoseOfTheVehiclesBlueWhileTheEventLasts) {
    const ReviewReportInput input = inputOf({driver(3, {100, 100}, {20, 0}, 20), driver(4, {100, 300}, {20, 0}, 20)});
    const Ground ground = groundOf(input, {eventOf({3}, 8, 12, 10, {300, 100})});
    ASSERT_EQ(ground.pictures.size(), 1U);
    const cv::Mat& picture = ground.pictures[0];
    const auto blue = [&](double x) { return blueAt(picture, onGround({x, 100}).x, onGround({x, 100}).y); };
    EXPECT_GT(blue(265), 80) << "from where it was in frame 8, at 260";
    EXPECT_GT(blue(335), 80) << "to where it was in frame 12, at 340";
    EXPECT_LT(blue(252), 40);
    EXPECT_LT(blue(348), 40);
    for (const double x : {104.0, 200.0, 420.0, 496.0}) {
        const cv::Point at = onGround({x, 100});
        EXPECT_TRUE(drawnAt(picture, at.x, at.y)) << x;
        EXPECT_FALSE(drawnAt(picture, at.x, at.y - 7)) << x;
        EXPECT_FALSE(drawnAt(picture, at.x, at.y + 7)) << x;
    }
    EXPECT_FALSE(drawnAt(picture, onGround({90, 100}).x, onGround({90, 100}).y));
    EXPECT_FALSE(drawnAt(picture, onGround({300, 300}).x, onGround({300, 300}).y)) << "another vehicle";
}

TEST(GroundPictures, AreMadeFinerOrCoarserAsTheGroundIsWide) {
    const auto width = [](int cols) {
        ReviewReportInput input = inputOf({});
        input.reviewed.tracks.footage.image_size = {cols, 200};
        const Ground ground = groundOf(input, {eventOf({}, 50, 50, 50, {300, 100})}, SameVideo({cols, 200}));
        return ground.pictures.at(0).size();
    };
    EXPECT_EQ(width(400), cv::Size(1200, 600));
    EXPECT_EQ(width(1500), cv::Size(1500, 200));
    EXPECT_EQ(width(2000), cv::Size(1800, 180));
}

TEST(GroundPictures, SixGroundsAreShownThoseWithMostEventsFirst) {
    // Eight grounds of ten frames each: nothing connects frames 9 and 10, 19 and 20 …
    ReviewReportInput input = inputOf({}, 25, true, 79);
    std::vector<Homography> steps;
    for (int frame = 0; frame < 79; ++frame) {
        if (frame % 10 == 9) continue;
        Homography step;
        step.from_frame = frame;
        step.to_frame = frame + 1;
        steps.push_back(step);
    }
    input.reviewed.tracks.footage.camera = CameraMotion(steps);
    std::vector<Event> events;
    for (const FrameIndex frame : {5, 15, 25, 35, 45, 55, 65, 65, 75, 75, 75})
        events.push_back(eventOf({}, frame, frame, frame, {300, 200}));
    const Ground ground = groundOf(input, events);
    EXPECT_EQ(ground.names,
              (std::vector<std::string>{"ground-8", "ground-7", "ground-1", "ground-2", "ground-3", "ground-4"}));
    EXPECT_EQ(ground.left_out, 2U);
    for (const cv::Mat& picture : ground.pictures) {
        const cv::Point middle(cvRound(300.5 / 640 * picture.cols), cvRound(200.5 / 400 * picture.rows));
        EXPECT_GT(redIn(picture, {middle.x - 12, middle.y - 12, 24, 24}), 20);
        EXPECT_FALSE(inkAt(picture, picture.cols / 4, picture.rows / 4)) << "painted";
    }
}

}  // namespace eyrie::event_pictures_test
