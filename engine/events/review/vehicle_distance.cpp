#include "events/review/vehicle_distance.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/geometry/homography_jacobian.h"

namespace eyrie {
namespace {

/// A track that was lost goes on in thought as it went for so long.
constexpr double kCourse_s = 1;

const TrackedBox* boxIn(const EventTrack& track, FrameIndex frame) {
    const auto box = std::lower_bound(track.boxes.begin(), track.boxes.end(), frame,
                                      [](const TrackedBox& each, FrameIndex wanted) { return each.frame < wanted; });
    return box != track.boxes.end() && box->frame == frame ? &*box : nullptr;
}

void keepNearer(std::optional<double>& nearest, std::optional<double> other) {
    if (other && (!nearest || *other < *nearest)) nearest = other;
}

}  // namespace

VehicleDistance::VehicleDistance(const StoredTracks& run, const ReviewOptions& options)
    : run_(run), options_(options), ground_(run.footage) {
    for (const EventTrack& track : run.tracks) tracks_[track.id] = &track;
}

std::optional<double> VehicleDistance::onGround(double metres) const {
    // Not a number is near nothing.
    if (!(metres <= options_.carry_distance_m)) return std::nullopt;
    return options_.carry_distance_m > 0 ? metres / options_.carry_distance_m : 0;
}

std::optional<double> VehicleDistance::between(const ReviewSubject& subject, const Event& event) const {
    std::optional<double> nearest;
    bool all_reach = !event.tracks.empty();
    for (const TrackId id : event.tracks) {
        const auto track = tracks_.find(id);
        if (track == tracks_.end()) {
            all_reach = false;
            continue;
        }
        if (!boxIn(*track->second, subject.frame)) all_reach = false;
        keepNearer(nearest, ofTrack(subject, *track->second));
    }
    // Where the vehicle is seen in that very frame, where it was in another one tells nothing.
    if (!all_reach) keepNearer(nearest, ofPlace(subject, event));
    return nearest;
}

std::optional<double> VehicleDistance::ofTrack(const ReviewSubject& subject, const EventTrack& track) const {
    const cv::Point2d place = subject.place;
    if (const TrackedBox* box = boxIn(track, subject.frame)) {
        return onGround(cv::norm(box->box.centre - place) * ground_.metresHere(subject.frame, place));
    }
    // It was lost before, or found after: where would it be?
    const bool before = track.boxes.back().frame < subject.frame;
    const TrackedBox& end = before ? track.boxes.back() : track.boxes.front();
    const double rate = run_.footage.scale.frame_rate_hz;
    if (std::abs(subject.frame - end.frame) > options_.carry_time_s * rate) return std::nullopt;
    const int stretch = ground_.indexOf(end.frame);
    if (stretch < 0 || stretch != ground_.indexOf(subject.frame)) return std::nullopt;
    const TrackedBox* from = &end;
    for (const TrackedBox& box : track.boxes) {
        if (std::abs(box.frame - end.frame) > kCourse_s * rate || ground_.indexOf(box.frame) != stretch) continue;
        if (std::abs(box.frame - end.frame) > std::abs(from->frame - end.frame)) from = &box;
    }
    cv::Point2d at = ground_.toGround(end.frame, end.box.centre);
    if (from != &end) {
        const cv::Point2d way = at - ground_.toGround(from->frame, from->box.centre);
        at += way * (static_cast<double>(subject.frame - end.frame) / (end.frame - from->frame));
    }
    return onGround(cv::norm(at - ground_.toGround(subject.frame, place)) *
                    ground_.metresByPlace(subject.frame, place));
}

std::optional<double> VehicleDistance::ofPlace(const ReviewSubject& subject, const Event& event) const {
    if (const auto map = run_.footage.camera.map(subject.frame, event.frame)) {
        const cv::Point2d there = HomographyJacobian(map->matrix, subject.place).point();
        return onGround(cv::norm(there - event.place) * ground_.metresHere(event.frame, event.place));
    }
    const double px = cv::norm(subject.place - event.place);
    if (!(px <= options_.carry_picture)) return std::nullopt;
    return options_.carry_picture > 0 ? px / options_.carry_picture : 0;
}

}  // namespace eyrie
