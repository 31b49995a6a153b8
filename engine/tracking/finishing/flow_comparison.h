#pragma once

#include <optional>

#include "tracking/ground_motion.h"

namespace eyrie {

/// How a track moved over the ground, beside how the ground itself moved through the picture. Medians over windows of
/// 24 frames.
struct FlowComparison {
    double ratio = 0;      ///< own motion to the ground's
    double fastest = 0;    ///< the same in the window of its fastest motion
    double alignment = 0;  ///< cosine of the angle between both
    double flow = 0;       ///< px/frame of the ground
};

/// Nothing where the track is too short or the ground's motion unknown.
std::optional<FlowComparison> comparedWithFlow(const TrackPath& path, const GroundMotion& ground);

}  // namespace eyrie
