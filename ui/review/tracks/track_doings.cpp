#include "review/tracks/track_doings.h"

#include <algorithm>
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

/// Standstills as events tell of them: from where it stops, or where its track begins, to where it starts, or where its
/// track ends. `events` in the order of frames.
std::vector<FrameSpan> standstillsOf(const EventTrack& track, const std::vector<const Event*>& events) {
    std::vector<FrameSpan> spans;
    std::optional<FrameIndex> since;
    bool stopped_before = false;
    for (const Event* event : events) {
        switch (event->kind) {
            case EventKind::stops:
                since = event->frame;
                stopped_before = true;
                break;
            case EventKind::starts:
                // One that stood from its beginning never stopped.
                if (!since && !stopped_before) since = track.boxes.front().frame;
                if (since) spans.push_back({*since, event->frame - 1});
                since.reset();
                stopped_before = true;
                break;
            case EventKind::stands:
                spans.push_back({event->first_frame, event->last_frame});
                break;
            default:
                break;
        }
    }
    if (since) spans.push_back({*since, track.boxes.back().frame});
    return mergedSpans(std::move(spans));
}

}  // namespace

const TrackDoings& doingsIn(const DoingsByTrack* doings, TrackId track) {
    static const TrackDoings nothing;
    if (doings == nullptr) return nothing;
    const auto found = doings->find(track);
    return found == doings->end() ? nothing : found->second;
}

int framesStood(const TrackDoings& did) {
    int frames = 0;
    for (const FrameSpan& span : did.standing) frames += span.last - span.first + 1;
    return frames;
}

bool standsIn(const TrackDoings& did, FrameIndex frame) {
    return std::any_of(did.standing.begin(), did.standing.end(),
                       [&](const FrameSpan& span) { return span.first <= frame && frame <= span.last; });
}

int eighthOf(double heading) {
    const int eighth = static_cast<int>(std::lround(heading / (std::numbers::pi / 4)));
    return ((eighth % kEighths) + kEighths) % kEighths;
}

DoingsByTrack doingsOf(const StoredTracks& run, const std::vector<Event>& events,
                       const std::map<TrackId, SpeedRange>& speeds) {
    DoingsByTrack doings;
    for (const auto& [track, range] : speeds) doings[track].speeds = range;
    for (const EventTrack& track : run.tracks) {
        const auto heading = headingOf(track, run.footage.camera);
        if (heading) doings[track.id].eighth = eighthOf(*heading);
    }
    std::map<TrackId, std::vector<const Event*>> events_of;
    for (const Event& event : events) {
        for (const TrackId track : event.tracks) {
            events_of[track].push_back(&event);
            doings[track].events.insert(event.kind);
            if (!event.zone.empty()) doings[track].zones.insert(event.zone);
        }
    }
    for (const EventTrack& track : run.tracks) {
        const auto had = events_of.find(track.id);
        if (had == events_of.end()) continue;
        std::stable_sort(had->second.begin(), had->second.end(),
                         [](const Event* a, const Event* b) { return a->first_frame < b->first_frame; });
        doings[track.id].standing = standstillsOf(track, had->second);
    }
    return doings;
}

}  // namespace eyrie::ui
