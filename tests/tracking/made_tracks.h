#pragma once

#include "tracking/track_manager.h"

namespace eyrie::test {

inline const SceneScale kFiveToAMetre{0.2, 25, true};  // 1 m are 5 px, 1 m/s is .2 px/frame
inline const cv::Size kPicture(640, 480);
inline constexpr double kSlow = 0.1;  // px/frame

inline TrackManager managerWith(const TrackerOptions& options = {}) {
    return TrackManager(options, kFiveToAMetre);
}

/// A confirmed track that was detected a hundred times and has driven ten of its lengths.
inline Track trackAt(const OrientedBox& box, cv::Point2d velocity = {1, 0}) {
    BoxMeasurement first;
    first.box = box;
    first.velocity = velocity;
    first.speed = 0.1;
    Track track(first);
    track.id = 1;
    track.status = TrackStatus::confirmed;
    track.hits = 100;
    track.origin_place = box.centre - 10 * box.length * box.direction();
    return track;
}

inline Track carAt(cv::Point2d centre, cv::Point2d velocity = {1, 0}) {
    return trackAt({centre, 20, 10, 0}, velocity);
}

}  // namespace eyrie::test
