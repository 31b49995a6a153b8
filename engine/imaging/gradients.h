#pragma once

#include <opencv2/core/mat.hpp>

/// The gradient magnitudes that the LBP gradient is compared with (Teutsch §5.4.1, fig. 5.14). Each takes CV_8UC1 and
/// makes CV_32FC1 of the same size, in grey values (per px for the first two); beyond the image its border is repeated.
namespace eyrie {

/// Without noise suppression: differences to the right and lower neighbour, M_x = (1 −1), M_y its transpose.
void simpleGradient(const cv::Mat& gray, cv::Mat& gradient);

/// Canny's gradient: first derivatives of a Gaussian with this variance (px²; the thesis uses 0.5). A ramp of slope 1
/// has magnitude 1.
void cannyGradient(const cv::Mat& gray, double variance, cv::Mat& gradient);

/// Morphological gradient: dilation minus erosion with a 3×3 square.
void morphologicalGradient(const cv::Mat& gray, cv::Mat& gradient);

}  // namespace eyrie
