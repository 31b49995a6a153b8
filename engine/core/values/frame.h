#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/values/ids.h"

namespace eyrie {

/// One image of a video.
struct Frame {
    FrameIndex index = 0;
    std::int64_t time_us = 0;  ///< presentation time from the start of the video, microseconds
    cv::Mat gray;              ///< CV_8UC1; never written after construction, so copies may share it
    cv::Mat colour;            ///< CV_8UC3, blue-green-red, for display; empty unless it was asked for
};

}  // namespace eyrie
