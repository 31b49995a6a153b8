#pragma once

#include <opencv2/core/mat.hpp>

namespace eyrie {

/// Hysteresis thresholding (Teutsch §5.4.2): 255 for pixels of at least `low` that are 8-connected, over pixels of at
/// least `low`, to one of at least `high`; else 0. `values` is CV_32SC1 or CV_32FC1; the result is CV_8UC1.
cv::Mat hysteresis(const cv::Mat& values, double low, double high);

}  // namespace eyrie
