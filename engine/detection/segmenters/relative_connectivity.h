#pragma once

#include <opencv2/core/mat.hpp>

namespace eyrie {

/// Relative connectivity along rows and columns (Teutsch §5.4.2, algorithm 1). Equidistant points of a scan line that
/// are all set, whose number n is at least `min_points` (T_m ≥ 2) and which end on both sides, add n to the accumulator
/// at their first and their last point; this for every distance that leaves room for `min_points`. Points beyond the
/// image are not set. `belonging`: CV_8UC1, the function f_b of eq. 5.15, 0: not set. Returns CV_32SC1.
cv::Mat relativeConnectivity(const cv::Mat& belonging, int min_points);

}  // namespace eyrie
