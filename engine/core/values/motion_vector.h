#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/values/corner.h"
#include "core/values/ids.h"

namespace eyrie {

/// A corner that moves independently of the camera (Teutsch §4.2), or a place without one whose motion was inferred: on
/// a plain roof or in a moving area (see inferred_ids.h).
struct MotionVector {
    CornerId id = 0;
    cv::Point2f position{0, 0};  ///< px in the current frame
    cv::Point2f velocity{0, 0};  ///< px/frame relative to the ground, in current image axes
    int age = 0;                 ///< frames the corner has been tracked; 0: inferred, there is no corner

    bool isInferred() const { return age == 0; }
};

/// The product of the first half of the chain (pixels → motion vectors) for one frame. Stored, so that the second half
/// can be run again without registering the video once more.
struct FrameMotion {
    FrameIndex frame = 0;
    std::int64_t time_us = 0;
    cv::Size image_size;
    Registration registration;
    std::vector<MotionVector> motion_vectors;     ///< sorted by ascending id
    std::vector<cv::Point2f> stationary_corners;  ///< px; background corners old enough to be judged
    int corner_count = 0;                         ///< all corners tracked into this frame
    PictureMask graphics;                         ///< where something is drawn into the picture; not stored
    double background_speed_sigma = 0;            ///< robust deviation of the background's residual speed, px/frame
};

}  // namespace eyrie
