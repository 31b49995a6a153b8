#include "georeference/video_world.h"

#include <algorithm>
#include <utility>

namespace eyrie {

VideoWorld videoWorldOf(const FrameSource* pixels, GeoFootage footage, std::optional<std::int64_t> start_utc_us,
                        const std::stop_token& stop) {
    if (pixels == nullptr) return videoWorldOf({nullptr, "the video cannot be read"}, std::move(footage), start_utc_us);
    // The video may have become shorter since the run.
    footage.last_frame = std::min(footage.last_frame, pixels->info().frame_count - 1);
    footage.time_us = [pixels](FrameIndex frame) { return pixels->timeOf(frame); };
    return videoWorldOf(metadataOf(*pixels, stop), std::move(footage), start_utc_us);
}

VideoWorld videoWorldOf(const FoundMetadata& found, GeoFootage footage, std::optional<std::int64_t> start_utc_us) {
    VideoWorld world;
    world.metadata = found.metadata;
    world.clock = VideoClock::of(found, start_utc_us);
    if (world.clock.source() == VideoClock::Source::none)
        world.no_clock = found.metadata ? "its metadata (KLV) hold no time" : found.why_not;
    world.places = GeoReference::byControl(footage, &world.control_remarks);
    world.no_places = found.why_not;
    if (found.metadata && !world.places.known()) {
        world.places = GeoReference(found.metadata->timeline(), std::move(footage));
        world.no_places = "its metadata (KLV) give no plausible place of the picture on the ground";
    }
    if (world.places.known())
        world.no_places.clear();
    else
        for (const std::string& why : world.control_remarks) world.no_places += "; " + why;
    for (const ControlFit& fit : world.places.controlFits())
        if (const std::string remark = remarkOn(fit); !remark.empty()) world.control_remarks.push_back(remark);
    return world;
}

}  // namespace eyrie
