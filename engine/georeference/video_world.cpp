#include "georeference/video_world.h"

#include <algorithm>
#include <utility>

namespace eyrie {

VideoWorld videoWorldOf(const FrameSource* pixels, GeoFootage footage, std::optional<std::int64_t> start_utc_us,
                        const std::stop_token& stop) {
    VideoWorld world;
    FoundMetadata found{nullptr, "the video cannot be read"};
    if (pixels != nullptr) found = metadataOf(*pixels, stop);
    world.metadata = found.metadata;
    world.clock = start_utc_us ? VideoClock::startingAt(*start_utc_us) : VideoClock::byMetadata(found.metadata);
    if (world.clock.source() == VideoClock::Source::none)
        world.no_clock = found.metadata ? "its metadata (KLV) hold no time" : found.why_not;
    std::vector<std::string> points_of_no_use;
    world.places = GeoReference::byControl(footage, &points_of_no_use);
    if (found.metadata && !world.places.known()) {
        // The video may have become shorter since the run.
        footage.last_frame = std::min(footage.last_frame, pixels->info().frame_count - 1);
        footage.time_us = [pixels](FrameIndex frame) { return pixels->timeOf(frame); };
        world.places = GeoReference(found.metadata->timeline(), std::move(footage));
        found.why_not = "its metadata (KLV) tell no place of the picture on the ground that can be believed";
    }
    if (world.places.known()) return world;
    world.no_places = found.why_not;
    for (const std::string& why : points_of_no_use) world.no_places += "; " + why;
    return world;
}

}  // namespace eyrie
