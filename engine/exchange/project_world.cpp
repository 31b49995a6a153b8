#include "exchange/project_world.h"

#include <cmath>
#include <utility>

#include "events/stored_events.h"
#include "georeference/video_world.h"

namespace eyrie {
namespace {

/// What the functions of a world ask; never moved, as parts refer to others.
struct WorldFacts {
    explicit WorldFacts(StoredTracks stored_tracks) : stored(std::move(stored_tracks)), ground(stored.footage) {}
    StoredTracks stored;
    GroundStretches ground;
    VideoWorld video;
};

}  // namespace

std::shared_ptr<const TrackWorld> trackWorldOf(const RunStore& store, const RunRecord& run, const FrameSource* pixels,
                                               std::optional<std::int64_t> start_utc_us, const std::stop_token& stop,
                                               std::vector<ControlPoint> control) {
    const auto facts = std::make_shared<WorldFacts>(readTracks(store, run));
    auto world = std::make_shared<TrackWorld>();
    const Footage& footage = facts->stored.footage;
    world->frame_rate_hz = footage.scale.frame_rate_hz;
    world->seconds = [facts](FrameIndex frame) { return facts->stored.secondsOf(frame); };
    if (footage.scale.gsd_known) {
        world->ground = [facts](FrameIndex frame, cv::Point2d px) -> std::optional<TrackWorld::GroundPlace> {
            const int stretch = facts->ground.indexOf(frame);
            if (stretch < 0) return std::nullopt;
            return TrackWorld::GroundPlace{stretch, facts->ground.toGround(frame, px)};
        };
    }
    facts->video = videoWorldOf(pixels,
                                {footage.image_size,
                                 footage.first_frame,
                                 footage.last_frame,
                                 footage.scale.frame_rate_hz,
                                 {},
                                 footage.camera,
                                 std::move(control)},
                                start_utc_us, stop);
    world->no_clock = facts->video.no_clock;
    world->no_place = facts->video.no_places;
    if (facts->video.places.known()) {
        world->place = [facts](FrameIndex frame, cv::Point2d px) { return facts->video.places.placeOf(frame, px); };
        world->height = [facts](FrameIndex frame) -> std::optional<TrackWorld::Height> {
            const auto height = facts->video.places.elevationOf(frame);
            if (!height) return std::nullopt;
            return TrackWorld::Height{height->metres, height->ellipsoid};
        };
        world->place_origin = facts->video.places.origin();
    }
    if (facts->video.clock.source() != VideoClock::Source::none) {
        world->utc_us = [facts](FrameIndex frame) {
            return facts->video.clock.at(std::llround(facts->stored.secondsOf(frame) * 1e6));
        };
        world->clock_origin = facts->video.clock.origin();
    }
    return world;
}

}  // namespace eyrie
