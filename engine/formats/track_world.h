#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/local_plane.h"
#include "core/values/ids.h"
#include "formats/label_file.h"

namespace eyrie {

/// When and where a video was taken, for formats that tell more than pixels. What is not known is empty. Functions,
/// since there are many frames; asked by one thread, best in ascending frames.
struct TrackWorld {
    /// A place on the ground as the run registered it.
    struct GroundPlace {
        int stretch = 0;       ///< places of different stretches cannot be compared; from 0
        cv::Point2d metres{};  ///< of the plane of the stretch's first frame, in its image's axes
    };
    /// A height, above the ellipsoid or above the sea.
    struct Height {
        double metres = 0;
        bool ellipsoid = false;
    };
    std::function<double(FrameIndex)> seconds;  ///< from the beginning of the video; always there
    std::function<std::optional<std::int64_t>(FrameIndex)> utc_us;
    std::function<std::optional<GroundPlace>(FrameIndex, cv::Point2d)> ground;  ///< only with a known GSD
    std::function<std::optional<GeoPoint>(FrameIndex, cv::Point2d)> place;
    std::function<std::optional<Height>(FrameIndex)> height;
    double frame_rate_hz = 25;
    std::string clock_origin, place_origin;  ///< for people; empty: not known
    std::string no_clock, no_place;          ///< why not, for people
};

/// What a box does on the ground.
struct GroundState {
    std::optional<double> speed_km_h;  ///< of its velocity
    std::optional<double> course_deg;  ///< clockwise from north; only where it moves and its place is known
    std::optional<double> length_m, width_m;
};
/// Metres are those of the run's scale or, where that is not known, of the places on the earth. Nothing is known
/// without either. `world` may be null.
GroundState groundStateOf(const TrackWorld* world, const LabelBox& box);

/// The world of labels for a format that is nothing without places or times. Throws Error(input) naming `path`, the
/// format and why none is known.
const TrackWorld& neededPlaces(const LabelFile& labels, const std::filesystem::path& path, const char* format);
const TrackWorld& neededTimes(const LabelFile& labels, const std::filesystem::path& path, const char* format);

}  // namespace eyrie
