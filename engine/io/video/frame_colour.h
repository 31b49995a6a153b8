#pragma once

#include "core/values/frame.h"

namespace eyrie {

/// The picture in colours, CV_8UC3, blue-green-red: its own, shared with the frame, or its greys.
cv::Mat colourOf(const Frame& frame);

}  // namespace eyrie
