#pragma once

#include <algorithm>

#include "tracking/finishing/track_finishing.h"

namespace eyrie::test {

/// Of a 640 × 360 px frame over flat ground that moves by `ground_shift` px/frame along x.
inline FrameMotionSummary summaryOfFrame(FrameIndex frame, double ground_shift = 0) {
    FrameMotionSummary summary;
    summary.frame = frame;
    summary.image_size = {640, 360};
    summary.registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
    Homography& homography = summary.registration.current_from_previous;
    homography.from_frame = std::max(0, frame - 1);
    homography.to_frame = frame;
    if (frame > 0) homography.matrix(0, 2) = ground_shift;
    return summary;
}

}  // namespace eyrie::test
