#include "review/tracks/track_doings.h"

#include <cmath>
#include <numbers>

namespace eyrie::ui {

namespace {

/// The way from the first to the last place that share a ground; nothing where it is shorter than the vehicle.
std::optional<double> headingOf(const EventTrack& track, const CameraMotion& camera) {
    if (track.boxes.empty()) return std::nullopt;
    const TrackedBox& first = track.boxes.front();
    const TrackedBox* last = &first;
    for (auto box = track.boxes.rbegin(); box != track.boxes.rend(); ++box) {
        if (!camera.connects(first.frame, box->frame)) continue;
        last = &*box;
        break;
    }
    const auto map = camera.map(last->frame, first.frame);
    if (!map) return std::nullopt;
    const cv::Vec3d there = map->matrix * cv::Vec3d(last->box.centre.x, last->box.centre.y, 1);
    if (!(there[2] > 0)) return std::nullopt;
    const cv::Point2d way = cv::Point2d(there[0] / there[2], there[1] / there[2]) - first.box.centre;
    if (std::hypot(way.x, way.y) < first.box.length) return std::nullopt;
    return std::atan2(way.y, way.x);
}

}  // namespace

int eighthOf(double heading) {
    const int eighth = static_cast<int>(std::lround(heading / (std::numbers::pi / 4)));
    return ((eighth % kEighths) + kEighths) % kEighths;
}

DoingsByTrack doingsOf(const StoredTracks& run, const std::vector<Event>& events) {
    DoingsByTrack doings;
    for (const EventTrack& track : run.tracks) {
        const auto heading = headingOf(track, run.footage.camera);
        if (heading) doings[track.id].eighth = eighthOf(*heading);
    }
    for (const Event& event : events) {
        for (const TrackId track : event.tracks) {
            doings[track].events.insert(event.kind);
            if (!event.zone.empty()) doings[track].zones.insert(event.zone);
        }
    }
    return doings;
}

}  // namespace eyrie::ui
