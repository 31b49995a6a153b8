#include "exchange/project_world.h"

#include <cmath>

#include "events/stored_events.h"
#include "georeference/geo_reference.h"
#include "georeference/video_clock.h"

namespace eyrie {
namespace {

/// What the functions of a world ask; never moved, as parts refer to others.
struct WorldFacts {
    explicit WorldFacts(StoredTracks stored_tracks) : stored(std::move(stored_tracks)), ground(stored.footage) {}
    StoredTracks stored;
    GroundStretches ground;
    GeoReference places;
    VideoClock clock;
};

}  // namespace

std::shared_ptr<const TrackWorld> trackWorldOf(const RunStore& store, const RunRecord& run, const FrameSource* pixels,
                                               std::optional<std::int64_t> start_utc_us, const std::stop_token& stop) {
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
    if (start_utc_us) facts->clock = VideoClock::startingAt(*start_utc_us);
    FoundMetadata found{nullptr, "the video cannot be read"};
    if (pixels != nullptr) found = metadataOf(*pixels, stop);
    if (found.metadata) {
        if (!start_utc_us) facts->clock = VideoClock::byMetadata(found.metadata);
        const FrameIndex last = std::min(footage.last_frame, pixels->info().frame_count - 1);
        facts->places = GeoReference(found.metadata->timeline(),
                                     {footage.image_size, footage.first_frame, last, footage.scale.frame_rate_hz,
                                      [pixels](FrameIndex frame) { return pixels->timeOf(frame); }, footage.camera});
        found.why_not = "its metadata (KLV) tell no place of the picture on the ground that can be believed";
    }
    if (facts->places.known()) {
        world->place = [facts](FrameIndex frame, cv::Point2d px) { return facts->places.placeOf(frame, px); };
        world->height = [facts](FrameIndex frame) -> std::optional<TrackWorld::Height> {
            const auto height = facts->places.elevationOf(frame);
            if (!height) return std::nullopt;
            return TrackWorld::Height{height->metres, height->ellipsoid};
        };
        world->place_origin = facts->places.origin();
    } else {
        world->no_place = found.why_not;
    }
    if (facts->clock.source() != VideoClock::Source::none) {
        world->utc_us = [facts](FrameIndex frame) {
            return facts->clock.at(std::llround(facts->stored.secondsOf(frame) * 1e6));
        };
        world->clock_origin = facts->clock.origin();
    } else {
        world->no_clock = found.metadata ? "its metadata (KLV) hold no time" : found.why_not;
    }
    return world;
}

}  // namespace eyrie
