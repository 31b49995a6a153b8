#pragma once

#include <opencv2/core/mat.hpp>

#include "io/video/libav.h"

namespace eyrie {

/// Turns decoded pictures into matrices. Grey is the luma itself, stretched to 0 … 255 where the video uses the limited
/// range 16 … 235, so it does not depend on whether colour is wanted too.
class PixelConversion {
 public:
    /// CV_8UC1 of the picture's own size; owns its pixels. Throws Error(input) for pixel formats that cannot be read.
    cv::Mat gray(const AVFrame& picture);
    /// CV_8UC3, blue-green-red, full range; owns its pixels. Throws Error(input).
    cv::Mat colour(const AVFrame& picture);

 private:
    libav::Scaler scaler_;
    cv::Mat luma_table_;      ///< 256 entries for 8 bit
    bool table_full_ = true;  ///< range that the table is for
};

}  // namespace eyrie
