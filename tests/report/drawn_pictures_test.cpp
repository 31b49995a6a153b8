#include <gtest/gtest.h>

#include <map>
#include <opencv2/imgproc.hpp>

#include "report/clip/annotator.h"
#include "report/driven_events.h"
#include "report/evaluation_report.h"

/// Pictures of reports and clips against the same drawn line by line, to the last grey level.
namespace eyrie::drawn_pictures_test {
namespace {

using test::driver;
using test::eventOf;
using test::greyFrame;
using test::inputOf;

const cv::Scalar kYellow(60, 220, 255), kGreen(80, 220, 80), kDark(20, 20, 20);

/// A point on sixteenths of a pixel of a picture so many times as large, middle on middle.
cv::Point placed(cv::Point2d video, double zoom, cv::Point2d corner = {0, 0}) {
    const cv::Point2d at = (video - corner) * zoom + cv::Point2d(zoom - 1, zoom - 1) * 0.5;
    return {cvRound(at.x * 16), cvRound(at.y * 16)};
}

/// Lines with a dark edge.
void outline(cv::Mat& picture, const std::vector<cv::Point>& points, bool closed, const cv::Scalar& colour) {
    cv::polylines(picture, points, closed, kDark, 3, cv::LINE_AA, 4);
    cv::polylines(picture, points, closed, colour, 1, cv::LINE_AA, 4);
}

std::string jpegOf(const cv::Mat& picture) {
    std::vector<unsigned char> bytes;
    cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, 85});
    return {bytes.begin(), bytes.end()};
}

double worstDifference(const std::string& a, const std::string& b) {
    const cv::Mat first = test::decoded(a), second = test::decoded(b);
    if (first.size() != second.size()) return 1e9;
    return cv::norm(first, second, cv::NORM_INF);
}

/// A slanted vehicle and its number, as on a still or a close-up.
void drawVehicle(cv::Mat& picture, const std::vector<cv::Point2d>& trail, const OrientedBox& box, TrackId id,
                 double zoom, cv::Point2d corner = {0, 0}) {
    std::vector<cv::Point> way, sides;
    for (const cv::Point2d& point : trail) way.push_back(placed(point, zoom, corner));
    for (const cv::Point2d& point : box.corners()) sides.push_back(placed(point, zoom, corner));
    if (way.size() > 1) outline(picture, way, false, kGreen);
    outline(picture, sides, true, kYellow);
    double right = -1e9, top = 1e9;
    for (const cv::Point2d& point : box.corners()) {
        right = std::max(right, point.x);
        top = std::min(top, point.y);
    }
    const cv::Point at = placed({right + 3, top}, zoom, corner);
    const cv::Point text(at.x >> 4, at.y >> 4);
    cv::putText(picture, std::to_string(id), text, cv::FONT_HERSHEY_SIMPLEX, 0.5, kDark, 3, cv::LINE_AA);
    cv::putText(picture, std::to_string(id), text, cv::FONT_HERSHEY_SIMPLEX, 0.5, kYellow, 1, cv::LINE_AA);
}

ReviewReportInput slanted() {
    ReviewReportInput input =
        inputOf({driver(7, {60, 120}, {2, 0.5}, 180), driver(8, {300, 300}, {0.5, -1}, 180)}, 25, true, 200);
    for (EventTrack& track : input.reviewed.tracks.tracks)
        for (TrackedBox& box : track.boxes) box.box.heading = 0.4;
    return input;
}

}  // namespace

TEST(DrawnPictures, AStillIsTheFrameWithFiveSecondsOfTrailBoxAndNumber) {
    const ReviewReportInput input = slanted();
    for (const FrameIndex frame : {160, 40, 0}) {
        const Event event = eventOf({7, 8}, frame, frame, frame, {1, 1});
        cv::Mat picture(600, 960, CV_8UC3, cv::Scalar::all(120));
        for (const EventTrack& track : input.reviewed.tracks.tracks) {
            std::vector<cv::Point2d> trail;
            for (FrameIndex f = std::max(0, frame - 125); f <= frame; ++f)
                trail.push_back(track.boxes[static_cast<std::size_t>(f)].box.centre);
            drawVehicle(picture, trail, track.boxes[static_cast<std::size_t>(frame)].box, track.id, 1.5);
        }
        EXPECT_EQ(eventStill(ReviewScene(input), event, greyFrame(frame)), jpegOf(picture)) << frame;
    }
    // Without a box there, a ring.
    const Event gone = eventOf({7}, 190, 190, 190, {400.25, 200.5});
    cv::Mat ringed(600, 960, CV_8UC3, cv::Scalar::all(120));
    std::vector<cv::Point> trail;
    for (int f = 190 - 125; f <= 180; ++f)
        trail.push_back(placed(input.reviewed.tracks.tracks[0].boxes[static_cast<std::size_t>(f)].box.centre, 1.5));
    outline(ringed, trail, false, kGreen);
    cv::circle(ringed, placed({400.25, 200.5}, 1.5), 14 * 16, kYellow, 2, cv::LINE_AA, 4);
    EXPECT_EQ(eventStill(ReviewScene(input), gone, greyFrame(190)), jpegOf(ringed));
}

TEST(DrawnPictures, StillsOfLargeFramesAreMadeSmallerByAreas) {
    ReviewReportInput input = inputOf({});
    input.reviewed.tracks.footage.image_size = {1920, 6};
    Frame frame;
    frame.index = 50;
    frame.gray = cv::Mat(6, 1920, CV_8UC1);
    cv::RNG(3).fill(frame.gray, cv::RNG::UNIFORM, 0, 256);
    cv::Mat colour, smaller;
    cv::cvtColor(frame.gray, colour, cv::COLOR_GRAY2BGR);
    cv::resize(colour, smaller, {960, 3}, 0, 0, cv::INTER_AREA);
    cv::circle(smaller, placed({100, 3}, 0.5), 14 * 16, kYellow, 2, cv::LINE_AA, 4);
    EXPECT_EQ(eventStill(ReviewScene(input), eventOf({}, 50, 50, 50, {100, 3}), frame), jpegOf(smaller));
}

TEST(DrawnPictures, ACloseUpIsFourVehiclesWideOrFortyEightPixelsHigh) {
    for (const double length : {40.0, 12.0}) {
        ReviewReportInput input = inputOf({driver(7, {200.5, 150.25}, {1, 0}, 100)});
        for (TrackedBox& box : input.reviewed.tracks.tracks[0].boxes)
            box.box = {box.box.centre, length / 2, length, 0.4};
        const double height = length > 16 ? length * 4 / (4.0 / 3) : 48;
        const double zoom = 240 / height;
        cv::Mat picture(240, 320, CV_8UC3, cv::Scalar::all(120));
        const OrientedBox box = input.reviewed.tracks.tracks[0].boxes[50].box;
        // The middle of the close-up, between two of its pixels, is that of the box.
        const cv::Point2d corner = box.centre - cv::Point2d(160, 120) * (1 / zoom) + cv::Point2d(0.5, 0.5);
        std::vector<cv::Point2d> trail;
        for (std::size_t f = 0; f <= 50; ++f) trail.push_back(input.reviewed.tracks.tracks[0].boxes[f].box.centre);
        drawVehicle(picture, trail, box, 7, zoom, corner);
        const Event event = eventOf({7}, 50, 50, 50, {1, 1});
        EXPECT_LE(worstDifference(eventCloseUp(ReviewScene(input), event, greyFrame(50)), jpegOf(picture)), 2)
            << length;
    }
}

TEST(DrawnPictures, OnTheGroundAreWaysRingsAndNumbers) {
    class GreyVideo : public FrameSource {
     public:
        GreyVideo() {
            info_.size = test::kVideo;
            info_.frame_count = 1000;
        }
        const VideoInfo& info() const override { return info_; }
        Frame read(FrameIndex index, bool) override { return greyFrame(index); }
        std::int64_t timeOf(FrameIndex index) const override { return index * 40'000LL; }

     private:
        VideoInfo info_;
    } video;
    ReviewReportInput input = inputOf({driver(3, {100, 100}, {4, 1}, 60), driver(4, {100, 300}, {4, 0}, 60)});
    input.reviewed.events = {eventOf({3}, 8, 22, 10, {140, 110}), eventOf({4}, 30, 40, 30, {220, 300}),
                             eventOf({}, 30, 30, 30, {223, 300}), eventOf({}, 5, 5, 5, {638, 2}),
                             eventOf({}, 5, 5, 5, {1, 398})};
    ReportFile report;
    addGround(ReviewScene(input), {0, 1, 2, 3, 4}, video, report, {}, {});
    cv::Mat picture(750, 1200, CV_8UC3, cv::Scalar::all(120));
    for (std::size_t k = 0; k < 2; ++k) {
        std::vector<cv::Point> all, part;
        const Event& event = input.reviewed.events[k];
        for (const TrackedBox& box : input.reviewed.tracks.tracks[k].boxes) {
            all.push_back(placed(box.box.centre, 1.875));
            if (box.frame >= event.first_frame && box.frame <= event.last_frame) part.push_back(all.back());
        }
        cv::polylines(picture, all, false, kDark, 3, cv::LINE_AA, 4);
        cv::polylines(picture, all, false, {230, 230, 230}, 1, cv::LINE_AA, 4);
        cv::polylines(picture, part, false, {230, 150, 45}, 3, cv::LINE_AA, 4);
    }
    const cv::Scalar red(70, 90, 255);
    for (const Event& event : input.reviewed.events) {
        const cv::Point at = placed(event.place, 1.875);
        cv::circle(picture, at, 9 * 16, kDark, 4, cv::LINE_AA, 4);
        cv::circle(picture, at, 9 * 16, red, 2, cv::LINE_AA, 4);
    }
    const std::vector<std::pair<std::size_t, std::string>> numbers{{0, "1"}, {1, "2, 3"}, {3, "4"}, {4, "5"}};
    for (const auto& [which, text] : numbers) {
        const cv::Point ring = placed(input.reviewed.events[which].place, 1.875);
        const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.5, 1, nullptr);
        cv::Point at(ring.x / 16 + 12, ring.y / 16 + size.height / 2);
        at.x = std::min(at.x, 1200 - size.width - 2);
        at.y = std::min(748, std::max(at.y, size.height + 2));
        cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.5, kDark, 4, cv::LINE_AA);
        cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.5, red, 1, cv::LINE_AA);
    }
    ASSERT_TRUE(report.pictures.contains("ground-1"));
    EXPECT_LE(worstDifference(report.pictures.at("ground-1").bytes, jpegOf(picture)), 3);
    EXPECT_EQ(report.pictures.at("ground-1").bytes.size(), jpegOf(picture).size()) << "of quality 85";
}

TEST(DrawnPictures, AClipHasTracksGreenAndWhatLedToThemInTheirColours) {
    for (const cv::Size size : {cv::Size(960, 400), cv::Size(320, 200)}) {
        const int zoom = 960 / size.width;
        Frame frame;
        frame.gray = cv::Mat(size, CV_8UC1, cv::Scalar(120));
        FrameResult result;
        TrackState track;
        track.id = 17;
        track.box = {{150.3, 80.6}, 40, 20, 0.4};
        track.status = TrackStatus::confirmed;
        result.tracks = {track};
        result.motion.motion_vectors.push_back({1, {40.5F, 50.25F}, {2.5F, -1}, 9});
        MotionCluster cluster;
        cluster.box = {{60.2, 120.7}, 30, 15, 0.3};
        result.clusters = {cluster};
        Detection kept;
        kept.box = {{200.1, 140.9}, 30, 15, -0.3};
        result.detections = {kept};
        Annotator annotator;
        FrameResult before = result;
        before.tracks[0].box.centre = {130.3, 75.6};
        annotator.follow(before);
        result.motion.registration.current_from_previous.matrix(0, 2) = 3;
        const cv::Mat drawn = annotator.draw(frame, result);

        cv::Mat picture(size * zoom, CV_8UC3, cv::Scalar::all(120));
        const auto line = [&](cv::Point2d a, cv::Point2d b, const cv::Scalar& colour) {
            cv::line(picture, placed(a, zoom), placed(b, zoom), colour, 1, cv::LINE_AA, 4);
        };
        const auto box = [&](const OrientedBox& each, const cv::Scalar& colour) {
            const auto corners = each.corners();
            for (std::size_t i = 0; i < 4; ++i) line(corners[i], corners[(i + 1) % 4], colour);
        };
        line({40.5, 50.25}, {53, 45.25}, {40, 220, 255});
        box(cluster.box, {230, 220, 0});
        box(kept.box, {60, 60, 240});
        line({133.3, 75.6}, track.box.centre, kGreen);
        box(track.box, kGreen);
        double top = 1e9;
        for (const cv::Point2d& corner : track.box.corners()) top = std::min(top, corner.y);
        const cv::Point at(cvRound(150.3 * zoom), cvRound(top * zoom) - 3);
        cv::putText(picture, "17", at, cv::FONT_HERSHEY_SIMPLEX, 0.4, {0, 0, 0}, 3, cv::LINE_AA);
        cv::putText(picture, "17", at, cv::FONT_HERSHEY_SIMPLEX, 0.4, kGreen, 1, cv::LINE_AA);
        EXPECT_EQ(cv::norm(drawn, picture, cv::NORM_INF), 0) << size;
    }
}

TEST(DrawnPictures, AnErrorsChipIsTheOutlineOnItsPlace) {
    class GreyVideo : public FrameSource {
     public:
        const VideoInfo& info() const override { return info_; }
        Frame read(FrameIndex index, bool) override { return greyFrame(index); }
        std::int64_t timeOf(FrameIndex index) const override { return index; }

     private:
        VideoInfo info_;
    } video;
    RunEvaluation e;
    e.run.sequence = {.path = "/videos/street.mp4", .size = test::kVideo, .frame_count = 10, .frame_rate_hz = 5};
    e.frames.push_back({0, 1, 0, 0});
    const OrientedBox box{{200.3, 150.6}, 30, 14, 0.4};
    DiagnosedError error;
    error.error.places.push_back({0, box, {0}, {}});
    e.errors = {error};
    const ReportFile report = makeEvaluationReport(e, &video);
    const double scale = 72 / std::max(box.upright().width * 2.6, box.upright().length * 2.6 / 1.6);
    cv::Mat picture(72, 115, CV_8UC3, cv::Scalar::all(120));
    std::vector<cv::Point> sides;
    for (const cv::Point2d& corner : box.corners())
        sides.emplace_back((corner - box.centre) * scale + cv::Point2d(57, 35.5));
    cv::polylines(picture, sides, true, kDark, 3, cv::LINE_AA);
    cv::polylines(picture, sides, true, kYellow, 1, cv::LINE_AA);
    EXPECT_EQ(cv::norm(test::decoded(report.pictures.at("chip-1").bytes), picture, cv::NORM_INF), 0);
    EXPECT_EQ(report.pictures.at("chip-1").width_mm, 21);
    EXPECT_EQ(report.pictures.at("figure-counts").width_mm, 160);
}

TEST(DrawnPictures, FramesAreReadOnceAndInTheirOrder) {
    class NotedVideo : public FrameSource {
     public:
        explicit NotedVideo(int frames) {
            info_.size = test::kVideo;
            info_.frame_count = frames;
        }
        const VideoInfo& info() const override { return info_; }
        Frame read(FrameIndex index, bool) override {
            asked.push_back(index);
            return greyFrame(index);
        }
        std::int64_t timeOf(FrameIndex index) const override { return index * 40'000LL; }
        std::vector<FrameIndex> asked;

     private:
        VideoInfo info_;
    };
    ReviewReportInput input = inputOf({driver(3, {100, 100}, {4, 0})});
    std::vector<Homography> steps(100);
    for (int frame = 0; frame < 100; ++frame) {
        steps[static_cast<std::size_t>(frame)].from_frame = frame;
        steps[static_cast<std::size_t>(frame)].to_frame = frame + 1;
        steps[static_cast<std::size_t>(frame)].matrix(0, 2) = -8;
    }
    input.reviewed.tracks.footage.camera = CameraMotion(steps);
    for (const FrameIndex frame : {70, 0, 70, 30})
        input.reviewed.events.push_back(eventOf({3}, frame, frame, frame, {9, 9}));
    input.reviewed.carried.of_event.resize(4);
    NotedVideo video(60);
    std::vector<double> told;
    const ReportFile report = makeReviewReport(input, &video, [&](double share) { told.push_back(share); });
    const std::vector<FrameIndex> stills(video.asked.begin(), video.asked.begin() + 3);
    EXPECT_EQ(stills, (std::vector<FrameIndex>{0, 30, 70}));
    ASSERT_GT(video.asked.size(), 4U);
    EXPECT_TRUE(std::is_sorted(video.asked.begin() + 3, video.asked.end()));
    EXPECT_LT(video.asked.back(), 60) << "of the ground only what the video has";
    ASSERT_GT(told.size(), 5U);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(told[i], 0.125 * static_cast<double>(i + 1));
    EXPECT_GT(told[4], 0.5);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_DOUBLE_EQ(told.back(), 1);
    std::map<std::string, double> widths;
    for (const auto& [name, picture] : report.pictures) widths[name.substr(0, name.find('-'))] = picture.width_mm;
    EXPECT_EQ(widths, (std::map<std::string, double>{
                          {"still", 92}, {"close", 44}, {"path", 44}, {"speed", 80}, {"ground", 170}}));
}

}  // namespace eyrie::drawn_pictures_test
