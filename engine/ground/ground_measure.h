#pragma once

#include <optional>

#include "events/ground/ground_stretches.h"

namespace eyrie {

/// A place as one frame shows it.
struct FramePoint {
    FrameIndex frame = 0;
    cv::Point2d at{0, 0};  ///< px
};

/// How far two places of the ground are from each other.
struct GroundMeasure {
    double metres = 0;  ///< by the scale, known or not
    double px = 0;      ///< as long as that seems in the frame of the second place
};

/// Nothing where no ground carries both frames.
std::optional<GroundMeasure> measureBetween(const GroundStretches& ground, const FramePoint& from,
                                            const FramePoint& to);
/// The place in another frame; nothing where that does not carry the same ground.
std::optional<FramePoint> carriedTo(const GroundStretches& ground, const FramePoint& point, FrameIndex frame);

}  // namespace eyrie
