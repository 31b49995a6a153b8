#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/geometry/oriented_box.h"
#include "imaging/following/box_follower.h"

namespace eyrie {

/// A box as followed.
struct FollowedBox {
    FrameIndex frame = 0;
    OrientedBox box;
    double certainty = 0;  ///< 0 … 1
};

/// How far a box could be followed, and why no farther.
struct FollowResult {
    std::vector<FollowedBox> boxes;  ///< in the order followed, without the starting frame; only those that are sure
    FollowEnd end = FollowEnd::end_of_range;
    FrameIndex end_frame = 0;  ///< where it ended: the first frame that is not sure
    std::string reason;        ///< for people: "stopped at frame 212: it does not look like the object any more (0.41)"
};

/// The grey picture (CV_8UC1) of a frame; empty where it cannot be read.
using GrayFrames = std::function<cv::Mat(FrameIndex)>;
/// Told of each box as it is found; for the screen.
using FollowProgress = std::function<void(const FollowedBox&)>;

/// Follows one box from `start` to `last` (before or after it), frame by frame, by corners inside the box (tracked
/// there and back) and by comparing with how it looked at the start and lately, until it gets unsure. The camera's
/// motion comes from `camera` where it is known and is estimated around the box where not. Deterministic.
FollowResult followBox(const OrientedBox& box, FrameIndex start, FrameIndex last, const GrayFrames& gray,
                       const CameraMotion& camera, const FollowOptions& options = {},
                       const FollowProgress& progress = {}, std::stop_token stop = {});

}  // namespace eyrie
