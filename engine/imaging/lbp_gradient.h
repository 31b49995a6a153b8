#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace eyrie {

/// Parameters of the gradient magnitude by local binary patterns (Teutsch §5.4.1).
struct LbpGradientOptions {
    std::vector<double> radii{1, 2};  ///< px, R_1 … R_n of eq. 5.13; each > 0
    double threshold = 3;             ///< grey values, T of eq. 5.7
};

/// Number of neighbours P on the circle.
inline constexpr int kLbpNeighbours = 8;

/// Multi-radius LBP gradient (eq. 5.7–5.13): sum over the radii of the neighbours' standard deviation where the pattern
/// is a contour (eq. 5.8–5.11: uniform, with 2 to 6 ones, classes 2–6 of fig. 5.11), 0 elsewhere. `gray` is CV_8UC1;
/// `gradient` becomes CV_32FC1 of the same size. Neighbours lie on a circle and are interpolated bilinearly; beyond the
/// image its border pixels are repeated.
void lbpGradient(const cv::Mat& gray, const LbpGradientOptions& options, cv::Mat& gradient);

}  // namespace eyrie
