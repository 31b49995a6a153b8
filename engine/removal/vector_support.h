#pragma once

#include "core/values/detection.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"

namespace eyrie {

/// Which motion vectors count as inside a detection.
struct SupportRule {
    double margin_px = 1;            ///< corners lie on outlines: the box is grown by this
    bool compare_velocity = true;    ///< only vectors that move like the detection
    double velocity_floor_px = 0.1;  ///< px/frame they may always differ by …
    double velocity_share = 0.2;     ///< … or by this share of the detection's speed
};

/// Sets `vectors` to those inside and `velocity` to their mean; with none inside the velocity stays.
void measureSupport(Detection& detection, const FrameMotion& motion, const SupportRule& rule);

/// Whether two velocities differ by no more than a floor (px/frame) or a share of the faster speed.
bool similarVelocity(cv::Point2d a, cv::Point2d b, double floor, double share);

}  // namespace eyrie
