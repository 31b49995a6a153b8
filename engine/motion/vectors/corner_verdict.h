#pragma once

#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "core/values/ids.h"

namespace eyrie {

/// What became of a corner in independent motion detection (Teutsch §4.2).
enum class CornerFate {
    moving,    ///< it became a motion vector
    young,     ///< not tracked for long enough
    slow,      ///< below the speed threshold
    too_fast,  ///< above the largest speed
    parallax,  ///< moves as a standing thing above the ground seems to
    shadow     ///< on the outline of a moving shadow
};

/// One corner of a frame with what it was judged by, to be looked at.
struct CornerVerdict {
    CornerId id = 0;
    cv::Point2f position{0, 0};  ///< px
    int age = 0;                 ///< frames since it was first detected
    bool on_background = false;  ///< agrees with the homography of the frame (RANSAC inlier)
    int baseline = 0;            ///< frames the speed was measured over; 0: too young to be measured
    double speed = 0;            ///< px/frame relative to the ground, in the test that came closest
    double limit = 0;            ///< px/frame the speed was compared with in that test
    CornerFate fate = CornerFate::young;
    std::string parameter;  ///< what decided, e.g. "motion.min_speed"; empty for moving corners
};

/// Verdicts on all corners of a frame, ascending id. Empty where nothing was measured (first, frozen or failed frames).
using CornerVerdicts = std::vector<CornerVerdict>;

}  // namespace eyrie
