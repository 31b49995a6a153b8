#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "georeference/geo_reference.h"
#include "georeference/video_clock.h"
#include "georeference/video_metadata.h"
#include "io/video/frame_source.h"

namespace eyrie {

/// When and where a video was taken, as far as anything tells.
struct VideoWorld {
    VideoClock clock;
    GeoReference places;
    std::shared_ptr<const VideoMetadata> metadata;  ///< null: none
    std::string no_clock, no_places;                ///< why they are not known, for people; empty when they are
    /// What is to be said against control points, for people: those that place nothing, and those that contradict.
    std::vector<std::string> control_remarks{};
};

/// `pixels` is the video, or null where it cannot be read: then there are no metadata. `footage`: what a run registered
/// of it; its times are those of `pixels`. `start_utc_us`: when the video began, µs since 1970-01-01, if a person says
/// so; else the metadata say it, else the file. Never throws for what is wrong with the metadata.
VideoWorld videoWorldOf(const FrameSource* pixels, GeoFootage footage, std::optional<std::int64_t> start_utc_us = {},
                        const std::stop_token& stop = {});

/// The same by metadata that were read before. The times of the footage are those of the video, and are asked for
/// during the call only.
VideoWorld videoWorldOf(const FoundMetadata& found, GeoFootage footage, std::optional<std::int64_t> start_utc_us = {});

}  // namespace eyrie
