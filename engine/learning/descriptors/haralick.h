#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

namespace eyrie {

/// Haralick's 13 texture features (1973): angular second moment, contrast, correlation, variance, inverse difference
/// moment, sum average, sum variance, sum entropy, entropy, difference variance, difference entropy, and both
/// information measures of correlation.
inline constexpr int kHaralickFeatures = 13;
inline constexpr int kHaralickLevels = 16;

/// `levels` is CV_8UC1 with values below 16. Pairs of pixels that lie `step` apart are counted both ways round.
std::array<float, kHaralickFeatures> haralickFeatures(const cv::Mat& levels, cv::Point step);

}  // namespace eyrie
