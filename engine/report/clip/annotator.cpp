#include "report/clip/annotator.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "io/video/frame_colour.h"

namespace eyrie {
namespace {

const cv::Scalar yellow(40, 220, 255);
const cv::Scalar cyan(230, 220, 0);
const cv::Scalar red(60, 60, 240);
const cv::Scalar green(80, 220, 80);
const cv::Scalar dark(0, 0, 0);

/// Fixed-point coordinates give cv's drawing functions sub-pixel places.
constexpr int kShift = 4;
cv::Point fixedPoint(cv::Point2d p, double zoom) {
    const double scale = zoom * (1 << kShift);
    const double offset = (zoom - 1) / 2 * (1 << kShift);
    return {cvRound(p.x * scale + offset), cvRound(p.y * scale + offset)};
}

void drawLine(cv::Mat& picture, cv::Point2d a, cv::Point2d b, double zoom, const cv::Scalar& colour) {
    cv::line(picture, fixedPoint(a, zoom), fixedPoint(b, zoom), colour, 1, cv::LINE_AA, kShift);
}

void drawBox(cv::Mat& picture, const OrientedBox& box, double zoom, const cv::Scalar& colour) {
    const auto corners = box.corners();
    for (std::size_t i = 0; i < 4; ++i) drawLine(picture, corners[i], corners[(i + 1) % 4], zoom, colour);
}

cv::Mat canvas(const Frame& frame, int zoom) {
    const cv::Mat colour = colourOf(frame);
    if (zoom == 1) return colour.clone();
    cv::Mat enlarged;
    cv::resize(colour, enlarged, {}, zoom, zoom, cv::INTER_CUBIC);
    return enlarged;
}

}  // namespace

int annotationZoom(cv::Size size) {
    return std::clamp(960 / std::max(size.width, 1), 1, 4);
}

cv::Mat Annotator::draw(const Frame& frame, const FrameResult& result) {
    const int zoom = annotationZoom(frame.gray.size());
    cv::Mat picture = canvas(frame, zoom);
    if (parts_ == Parts::all) {
        for (const auto& vector : result.motion.motion_vectors) {
            const cv::Point2d from = vector.position;
            drawLine(picture, from, from + cv::Point2d(vector.velocity) * 5, zoom, yellow);
        }
        for (const auto& cluster : result.clusters) drawBox(picture, cluster.box, zoom, cyan);
        for (const auto& detection : result.detections) {
            if (detection.rejection == Rejection::none) drawBox(picture, detection.box, zoom, red);
        }
    }
    follow(result);
    drawTracks(picture, result, zoom);
    return picture;
}

void Annotator::follow(const FrameResult& result) {
    std::map<TrackId, std::deque<cv::Point2d>> living;
    for (const auto& track : result.tracks) {
        auto& trail = living[track.id];
        trail = std::move(trails_[track.id]);
        // The ground moves under the camera, and the trail with it.
        for (auto& point : trail) point = result.motion.registration.current_from_previous.apply(point);
        trail.push_back(track.box.centre);
        if (trail.size() > kTrailFrames) trail.pop_front();
    }
    trails_ = std::move(living);
}

void Annotator::drawTracks(cv::Mat& picture, const FrameResult& result, double zoom) const {
    for (const auto& track : result.tracks) {
        if (track.status == TrackStatus::tentative) continue;
        const auto& trail = trails_.at(track.id);
        for (std::size_t i = 1; i < trail.size(); ++i) drawLine(picture, trail[i - 1], trail[i], zoom, green);
        drawBox(picture, track.box, zoom, green);
        const cv::Point2d top(track.box.centre.x, track.box.centre.y - track.box.upright().width / 2);
        const cv::Point at(cvRound(top.x * zoom), cvRound(top.y * zoom) - 3);
        const std::string label = std::to_string(track.id);
        cv::putText(picture, label, at, cv::FONT_HERSHEY_SIMPLEX, 0.4, dark, 3, cv::LINE_AA);
        cv::putText(picture, label, at, cv::FONT_HERSHEY_SIMPLEX, 0.4, green, 1, cv::LINE_AA);
    }
}

}  // namespace eyrie
