#pragma once

#include <optional>

#include "tracking/ground_motion.h"

namespace eyrie {

/// How a track moved, explained by a thing that stands and rises above the ground while the camera passes. Medians over
/// windows of 24 frames.
struct ImpliedHeight {
    double height = 0;   ///< as a share of the flight height, −0.2 … 0.9
    double rest = 0;     ///< px by which it moved otherwise
    double moved = 0;    ///< px that it moved over the ground
    double oblique = 0;  ///< cosine of the angle between the viewing direction and straight down
};

/// From the camera's translation and the ground's plane, which the ground's motion through the picture tells up to
/// scale for a usual lens; it matters little which. Unlike the ground's flow they also tell of a camera that circles
/// what it looks at. Nothing where the track is too short or the ground's motion unknown.
std::optional<ImpliedHeight> impliedHeightOf(const TrackPath& path, const GroundMotion& ground);

}  // namespace eyrie
