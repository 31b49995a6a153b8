#pragma once

#include <opencv2/core/mat.hpp>

namespace eyrie {

/// How dark a picture (CV_8UC1) is, by its median: 0 by day and under street lamps, 1 where next to nothing but lamps
/// and what they light is seen.
double darknessOf(const cv::Mat& gray);

}  // namespace eyrie
