#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace eyrie {

/// Quantile threshold (Teutsch §5.4.1, fig. 5.16): the smallest value that the brightest share `q` of the pixels in
/// `mask` reaches. Only values > 0 may reach it: where fewer than the share q are positive, the smallest positive value
/// is returned, and nothing when there is none. `values` CV_32FC1 ≥ 0, `mask` CV_8UC1 of the same size (0: not
/// counted).
std::optional<float> quantileThreshold(const cv::Mat& values, const cv::Mat& mask, double q);

/// The values that a quantile threshold is taken from.
struct RankedValues {
    std::vector<float> positive;  ///< descending
    std::size_t counted = 0;      ///< pixels in the mask, those of 0 too
};
RankedValues rankedValues(const cv::Mat& values, const cv::Mat& mask);
/// The same threshold from ranked values, for many quantiles of one image.
std::optional<float> quantileThreshold(const std::vector<float>& ranked, std::size_t counted, double q);

/// Eq. 5.14 within `mask`: 255 where the value reaches the threshold, else 0 (CV_8UC1).
void binarise(const cv::Mat& values, const cv::Mat& mask, float threshold, cv::Mat& binary);

}  // namespace eyrie
