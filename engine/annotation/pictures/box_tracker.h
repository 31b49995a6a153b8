#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/geometry/oriented_box.h"

namespace eyrie {

/// Why following a box ended.
enum class FollowEnd {
    end_of_range,  ///< the frame asked for was reached
    left_image,    ///< less than half of the box is in the image
    few_corners,   ///< hardly any corner of the object could be tracked and the template did not help
    appearance,    ///< it does not look like the object any more
    jump,          ///< it would have moved or turned as no vehicle does
    no_picture,    ///< the frame could not be read
    stopped        ///< by the caller
};

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

/// When following a box ends because it is no longer sure.
struct FollowOptions {
    double min_certainty = 0.45;
    double min_start_likeness = 0.3;  ///< correlation with how it looked at the start, −1 … 1
    int max_corners = 40;
    double max_forward_backward_px = 0.7;
    double max_speed_change_px = 4;  ///< px/frame, against the speed of the frames before
    double max_standing_px = 0.4;    ///< px/frame over the ground: up to that it waits
    double min_seen = 0.5;           ///< share of what waits that must be seen while others pass in front of it …
    int max_hidden_frames = 45;      ///< … but for so long, if it is seen again afterwards
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
