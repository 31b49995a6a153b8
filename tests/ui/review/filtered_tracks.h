#pragma once

#include <memory>
#include <string>
#include <vector>

#include "review/events/found_events.h"
#include "review/tracks/track_filter.h"

namespace eyrie::ui::test {

inline const SceneScale kMetres{0.1, 25, true};

/// Track n is n frames long and drives n px a frame: at 0.1 m/px and 25 Hz 9·n km/h.
inline TrackSummary trackOf(int n) {
    TrackSummary track;
    track.id = n;
    track.first_frame = 100;
    track.last_frame = 100 + 25 * n - 1;
    track.frames = 25 * n;
    track.confirmed = true;
    track.mean_speed_px = n;
    track.mean_length_px = 40;
    track.score = n / 10.0;
    return track;
}

inline std::vector<TrackSummary> tenTracks() {
    std::vector<TrackSummary> tracks;
    for (int n = 1; n <= 10; ++n) tracks.push_back(trackOf(n));
    return tracks;
}

/// Track 1 drives right and enters the yard; track 2 drives down and is lost; track 3 stands.
inline std::shared_ptr<StoredTracks> threeDriven() {
    auto run = std::make_shared<StoredTracks>();
    run->footage.image_size = {640, 400};
    run->footage.last_frame = 99;
    run->footage.scale = kMetres;
    std::vector<Homography> steps;  // the picture drifts to the left by a pixel a frame
    for (int frame = 1; frame < 100; ++frame) {
        Homography step;
        step.from_frame = frame - 1;
        step.to_frame = frame;
        step.matrix = {1, 0, -1, 0, 1, 0, 0, 0, 1};
        steps.push_back(step);
    }
    run->footage.camera = CameraMotion(steps);
    const auto drive = [&](TrackId id, cv::Point2d speed) {
        EventTrack track;
        track.id = id;
        for (int frame = 0; frame < 100; ++frame)
            track.boxes.push_back({frame, {cv::Point2d(200 - frame, 200) + speed * frame, 20, 8, 0}});
        run->tracks.push_back(track);
    };
    drive(1, {2, 0});
    drive(2, {0.1, 1});
    drive(3, {0, 0});
    return run;
}

inline Event happening(EventKind kind, TrackId track, const std::string& zone = "") {
    Event event;
    event.kind = kind;
    event.tracks = {track};
    event.zone = zone;
    return event;
}

}  // namespace eyrie::ui::test
