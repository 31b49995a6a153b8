#pragma once

#include <array>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/local_plane.h"
#include "metadata/metadata_timeline.h"

namespace eyrie {

/// What a view of the ground was found by, best first.
enum class GroundSource {
    corners,         ///< the frame's corners as stated in full (tags 82 … 89)
    corner_offsets,  ///< the corners as offsets from the frame centre (tags 26 … 33): to about 0.25 m, within 8 km
    attitude,        ///< cast from where the sensor is and looks to, onto a level ground
    target_width,    ///< only a scale: the stated width of what is seen
    slant_range,     ///< only a scale: distance and field of view
    none
};
/// For people: "the frame corners".
const char* nameOf(GroundSource source);

/// How a frame lies on the ground by its metadata. The ground is taken for a plane.
struct GroundView {
    GroundSource source = GroundSource::none;              ///< of footprint, north and places
    std::optional<std::array<GeoPoint, 4>> footprint;      ///< outer corners of the image: upper left, then clockwise
    std::optional<double> north_deg;                       ///< in the middle of the image, clockwise from +x
    GroundSource scale_source = GroundSource::none;        ///< of the scale
    std::optional<double> gsd_x_m_per_px, gsd_y_m_per_px;  ///< in the middle of the image, along its axes
    std::vector<std::string> remarks;                      ///< what was stated but not believed, and why

    /// One figure for both axes: their geometric mean; the one that is known where the other is missing.
    std::optional<double> gsd() const;
    /// The place under a pixel; nothing without a footprint, or for a pixel beyond the horizon.
    std::optional<GeoPoint> placeOf(cv::Point2d px) const;
    /// The pixel of a place; nothing without a footprint, or for a place behind the camera.
    std::optional<cv::Point2d> pixelOf(const GeoPoint& place) const;

    LocalPlane plane;
    std::optional<cv::Matx33d> to_plane;  ///< pixels to metres on the plane
};

/// Takes the best source that is complete and believable:
/// 1. the corners, if all eight numbers are known, they are the outline of a picture seen from above (convex, not
///    mirrored, 0.05 m to 200 km a side) and the frame centre, where stated, lies in it or close by;
/// 2. the offsets of the corners, likewise, with the frame centre;
/// 3. the attitude: position, altitude, platform heading, sensor azimuth and elevation, horizontal field of view;
/// pitch,
///    roll and the roll of the sensor count as 0 where they are missing, the vertical field of view follows from the
///    picture; the ground lies at the elevation of the frame centre or, failing that, at the end of the slant range.
///    All corners must look below the horizon.
/// The scale comes from the same, or else from the target width, or from slant range and field of view.
GroundView groundViewOf(const MetadataState& state, cv::Size size);

}  // namespace eyrie
