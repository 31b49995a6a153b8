#pragma once

#include <opencv2/core/matx.hpp>

namespace eyrie {

/// The same homography with a one in its last place.
inline cv::Matx33d scaledToOne(const cv::Matx33d& m) {
    return m * (1.0 / m(2, 2));
}

/// The same map so many times in a row; scaled to 1, too.
inline cv::Matx33d powerOf(const cv::Matx33d& m, int exponent) {
    cv::Matx33d result = cv::Matx33d::eye();
    for (int i = 0; i < exponent; ++i) result = m * result;
    return scaledToOne(result);
}

}  // namespace eyrie
