#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "io/video/frame_colour.h"
#include "report/review/review_parts.h"

namespace eyrie {
namespace {

constexpr int kStillWidth = 960;
constexpr int kCloseUpHeight = 240;
constexpr double kCloseUpShape = 4.0 / 3;
constexpr double kCloseUpAround = 4;  ///< a close-up is as many vehicles wide
constexpr int kSmallestCloseUp = 48;  ///< px of the video
constexpr double kTrail_s = 5;
constexpr int kJpegQuality = 85;
constexpr int kFixedBits = 4;

const cv::Scalar kBoxColour(60, 220, 255);
const cv::Scalar kTrailColour(80, 220, 80);
const cv::Scalar kEdgeColour(20, 20, 20);

std::string jpegOf(const cv::Mat& picture) {
    std::vector<unsigned char> bytes;
    cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
    return {bytes.begin(), bytes.end()};
}

/// A part of the video's picture, enlarged, with drawing in px of the video.
struct Cutting {
    cv::Mat picture;
    cv::Point2d corner;  ///< upper left pixel's centre, px of the video
    double zoom = 1;

    cv::Point at(cv::Point2d p) const {
        const cv::Point2d placed = ((p - corner) * zoom + cv::Point2d(0.5, 0.5) * (zoom - 1)) * (1 << kFixedBits);
        return {cvRound(placed.x), cvRound(placed.y)};
    }
    void lines(const std::vector<cv::Point2d>& points, bool closed, const cv::Scalar& colour) const {
        std::vector<cv::Point> placed;
        for (const cv::Point2d& point : points) placed.push_back(at(point));
        cv::polylines(picture, placed, closed, kEdgeColour, 3, cv::LINE_AA, kFixedBits);
        cv::polylines(picture, placed, closed, colour, 1, cv::LINE_AA, kFixedBits);
    }
};

void drawVehicle(const Cutting& cutting, const ReviewScene& scene, TrackId track, FrameIndex frame) {
    const Footage& footage = scene.input().reviewed.tracks.footage;
    const int first = frame - static_cast<int>(kTrail_s * footage.scale.frame_rate_hz);
    std::vector<cv::Point2d> trail;
    for (FrameIndex before = std::max(first, footage.first_frame); before <= frame; ++before) {
        const OrientedBox* box = scene.boxOf(track, before);
        const auto here = box != nullptr ? footage.camera.map(before, frame) : std::nullopt;
        if (here) trail.push_back(here->apply(box->centre));
    }
    if (trail.size() > 1) cutting.lines(trail, false, kTrailColour);
    const OrientedBox* box = scene.boxOf(track, frame);
    if (box == nullptr) return;
    const auto corners = box->corners();
    cutting.lines({corners.begin(), corners.end()}, true, kBoxColour);
    const OrientedBox upright = box->upright();
    const cv::Point label = cutting.at(box->centre + cv::Point2d(upright.length / 2 + 3, -upright.width / 2));
    const cv::Point at(label.x >> kFixedBits, label.y >> kFixedBits);
    const std::string text = std::to_string(track);
    cv::putText(cutting.picture, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.5, kEdgeColour, 3, cv::LINE_AA);
    cv::putText(cutting.picture, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.5, kBoxColour, 1, cv::LINE_AA);
}

void drawEvent(const Cutting& cutting, const ReviewScene& scene, const Event& event) {
    for (const TrackId track : event.tracks) drawVehicle(cutting, scene, track, event.frame);
}

}  // namespace

std::string eventStill(const ReviewScene& scene, const Event& event, const Frame& frame) {
    const cv::Mat colour = colourOf(frame);
    Cutting still;
    still.zoom = static_cast<double>(kStillWidth) / colour.cols;
    const cv::Size size(kStillWidth, std::max(1, cvRound(colour.rows * still.zoom)));
    cv::resize(colour, still.picture, size, 0, 0, still.zoom < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
    drawEvent(still, scene, event);
    // Where nothing is outlined, the place is marked.
    if (event.tracks.empty() || scene.boxOf(event.tracks.front(), event.frame) == nullptr)
        cv::circle(still.picture, still.at(event.place), 14 << kFixedBits, kBoxColour, 2, cv::LINE_AA, kFixedBits);
    return jpegOf(still.picture);
}

std::string eventCloseUp(const ReviewScene& scene, const Event& event, const Frame& frame) {
    const OrientedBox* box = event.tracks.empty() ? nullptr : scene.boxOf(event.tracks.front(), event.frame);
    const cv::Point2d middle = box != nullptr ? box->centre : event.place;
    const double vehicle = box != nullptr ? std::max(box->length, box->width) : 0;
    const double height = std::max<double>(kSmallestCloseUp, vehicle * kCloseUpAround / kCloseUpShape);
    Cutting close;
    close.zoom = kCloseUpHeight / height;
    const cv::Size size(cvRound(kCloseUpHeight * kCloseUpShape), kCloseUpHeight);
    // Half a pixel of the video lies before the centre of the first.
    close.corner = middle - cv::Point2d(size.width, size.height) * (0.5 / close.zoom) + cv::Point2d(0.5, 0.5);
    const double offset = (close.zoom - 1) / 2;
    const cv::Matx23d video_from_close(1 / close.zoom, 0, close.corner.x - offset / close.zoom,  //
                                       0, 1 / close.zoom, close.corner.y - offset / close.zoom);
    cv::warpAffine(colourOf(frame), close.picture, video_from_close, size, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                   cv::BORDER_CONSTANT, cv::Scalar::all(60));
    drawEvent(close, scene, event);
    return jpegOf(close.picture);
}

}  // namespace eyrie
