#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/values/ids.h"

namespace eyrie::ui {

/// Where a track was in the frames before, carried along with the camera into the pixels of the frame shown.
struct Trail {
    TrackId id = 0;
    std::vector<cv::Point2f> points;  ///< box centres, oldest first; the last is the present one
};

}  // namespace eyrie::ui
