#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "motion/differences/registered_frames.h"

namespace eyrie {

/// The ground without what moves over it.
struct Background {
    cv::Mat gray;   ///< CV_8UC1
    cv::Mat known;  ///< CV_8UC1, 255 where at least half of the pictures show something
};

/// Pixelwise median of pictures laid over each other (Teutsch §2.2, eq. 2.3): exact; over the pictures that show the
/// pixel, the lower of the two middle values of an even number. All of one size; at least one.
Background medianBackground(const std::vector<WarpedFrame>& pictures);

/// Gradient magnitude of the background, CV_32FC1, grey values per px.
cv::Mat backgroundGradient(const cv::Mat& gray);

}  // namespace eyrie
