#pragma once

#include <opencv2/core/types.hpp>
#include <optional>

#include "annotation/keyframes/camera_motion.h"
#include "events/event.h"

namespace eyrie {

/// How a vehicle lies in a frame, for whoever looks after it.
struct FollowedPose {
    cv::Point2d centre{0, 0};  ///< px
    double heading = 0;        ///< radians; steadier than that of a single box
    double length = 0;         ///< px
};

/// Nothing in frames that the track has no box in. The heading is the mean over half a second around the frame, each
/// carried into it over the ground, so that a camera that turns does not turn it.
std::optional<FollowedPose> followedPose(const EventTrack& track, FrameIndex frame, const CameraMotion& camera);

}  // namespace eyrie
