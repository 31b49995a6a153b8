#pragma once

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "report/review/review_parts.h"

/// Events of vehicles that drive straight on, with every place worked out by hand.
namespace eyrie::test {

inline const cv::Size kVideo(640, 400);

/// A vehicle of 40 × 20 px that drives evenly from `start` over frames `first` … `last`; there it is where it would be
/// had it driven since frame 0.
inline EventTrack driver(TrackId id, cv::Point2d start, cv::Point2d step, int last = 100, int first = 0) {
    EventTrack track;
    track.id = id;
    for (int frame = first; frame <= last; ++frame)
        track.boxes.push_back({frame, {start + step * static_cast<double>(frame), 40, 20, 0}});
    return track;
}

/// Half a metre a pixel, and a camera that stands still.
inline ReviewReportInput inputOf(std::vector<EventTrack> tracks, double rate_hz = 25, bool gsd_known = true,
                                 int last = 100) {
    ReviewReportInput input;
    StoredTracks& stored = input.reviewed.tracks;
    stored.tracks = std::move(tracks);
    stored.footage.camera = CameraMotion::standing(0, last);
    stored.footage.image_size = kVideo;
    stored.footage.last_frame = last;
    stored.footage.scale = {0.5, rate_hz, gsd_known};
    return input;
}

inline Event eventOf(std::vector<TrackId> tracks, FrameIndex first, FrameIndex last, FrameIndex frame,
                     cv::Point2d place) {
    Event event;
    event.tracks = std::move(tracks);
    event.first_frame = first;
    event.last_frame = last;
    event.frame = frame;
    event.place = place;
    return event;
}

/// Half a metre east for a pixel along `east`, half a metre north for one along `north`.
inline GeoReference placesAlong(cv::Point2d east, cv::Point2d north) {
    const LocalPlane plane(GeoPoint{48, 11});
    GeoFootage footage;
    footage.image_size = kVideo;
    footage.last_frame = 100;
    footage.camera = CameraMotion::standing(0, 100);
    for (const cv::Point2d px :
         {cv::Point2d(20, 20), cv::Point2d(620, 20), cv::Point2d(620, 380), cv::Point2d(20, 380)})
        footage.control.push_back({0, px, plane.placeOf({px.dot(east) / 2, px.dot(north) / 2})});
    return GeoReference::byControl(footage);
}

inline cv::Mat decoded(const std::string& picture) {
    return cv::imdecode(std::vector<char>(picture.begin(), picture.end()), cv::IMREAD_COLOR);
}

inline bool inkAt(const cv::Mat& picture, int x, int y) {
    const cv::Vec3b& pixel = picture.at<cv::Vec3b>(y, x);
    return std::abs(pixel[0] - 120) + std::abs(pixel[1] - 120) + std::abs(pixel[2] - 120) > 90;
}

/// Whether something is drawn on the grey picture there or within two pixels, which JPEG may have moved it by.
inline bool drawnAt(const cv::Mat& picture, int x, int y) {
    bool drawn = false;
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) drawn |= inkAt(picture, x + dx, y + dy);
    return drawn;
}

inline Frame greyFrame(FrameIndex index) {
    Frame frame;
    frame.index = index;
    frame.gray = cv::Mat(kVideo, CV_8UC1, cv::Scalar(120));
    return frame;
}

}  // namespace eyrie::test
