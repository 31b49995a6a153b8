#pragma once

#include <array>
#include <opencv2/core/types.hpp>
#include <optional>

#include "core/geometry/local_plane.h"
#include "metadata/metadata_timeline.h"

namespace eyrie {

/// Where the corners of an image lie on level ground, cast from the sensor.
struct CastCorners {
    GeoPoint sensor;                       ///< the point on the ground below it
    std::array<cv::Point2d, 4> corners_m;  ///< metres east and north of it: upper left, then clockwise
};

/// Nothing where a part is missing (GroundView says which are needed), or where a corner looks above the horizon.
std::optional<CastCorners> castCorners(const MetadataState& state, cv::Size size);

/// The fields of view that a state gives, degrees; the vertical one follows from the picture where it is missing, for
/// square pixels.
struct FieldOfView {
    double horizontal_deg = 0;
    double vertical_deg = 0;
};
std::optional<FieldOfView> fieldOfView(const MetadataState& state, cv::Size size);

/// How far the sensor is above the ground that it looks at, m.
std::optional<double> heightAboveGround(const MetadataState& state);

}  // namespace eyrie
