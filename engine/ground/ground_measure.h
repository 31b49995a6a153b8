#pragma once

#include <optional>

#include "core/values/scene_scale.h"
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

/// Nothing where no ground carries both frames. In an oblique view the scale is that of the place in the frame of the
/// second one, else that of the ground.
std::optional<GroundMeasure> measureBetween(const GroundStretches& ground, const FramePoint& from,
                                            const FramePoint& to);
/// Two places of one frame by the scale there: in an oblique view that of the middle between them.
GroundMeasure measureInFrame(const SceneScale& scale, cv::Point2d from, cv::Point2d to);
/// The place in another frame; nothing where that does not carry the same ground.
std::optional<FramePoint> carriedTo(const GroundStretches& ground, const FramePoint& point, FrameIndex frame);

}  // namespace eyrie
