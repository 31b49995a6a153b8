#pragma once

#include <opencv2/core/mat.hpp>

#include "motion/differences/background_model.h"
#include "motion/differences/registered_frames.h"

namespace eyrie {

/// What changed between registered pictures, as seen in the newest one.
struct DifferenceImage {
    cv::Mat values;       ///< CV_32FC1, grey values ≥ 0; 0 outside the overlap
    cv::Mat overlap;      ///< CV_8UC1, A_o: 255 where all pictures show something
    cv::Mat reference{};  ///< CV_8UC1, what was compared with: the earlier picture laid over, or the background
};

/// |I_1 − I_2| of eq. 2.1. `blur_px`: deviation of the Gaussian before it, 0: none.
DifferenceImage twoFrameDifference(const cv::Mat& now, const WarpedFrame& before, double blur_px);

/// min(|I_1 − I_2|, |I_2 − I_3|) of eq. 2.2: answers where vehicles were in the middle picture `before`, and hardly
/// where they were in the others. Laid over the newest one.
DifferenceImage threeFrameDifference(const cv::Mat& now, const WarpedFrame& before, const WarpedFrame& long_before,
                                     double blur_px);

/// |I − I_BG| of eq. 2.3, less `gradient_suppression` times the background's gradient.
DifferenceImage backgroundDifference(const cv::Mat& now, const Background& background, double gradient_suppression,
                                     double blur_px);

/// Robust deviation of the differences inside the overlap: median / 0.6745, since most of the picture stands still.
double differenceNoise(const DifferenceImage& difference);

/// Pixels that move: those above `low` that belong to an area with a pixel above Otsu's threshold of what is above
/// `low`, the latter limited to `strong_limit` times `low`. CV_8UC1.
cv::Mat movingPixels(const DifferenceImage& difference, double low, double strong_limit);

}  // namespace eyrie
