#pragma once

#include <opencv2/core/matx.hpp>

namespace eyrie {

/// The same homography with a one in its last place.
inline cv::Matx33d scaledToOne(const cv::Matx33d& m) {
    return m * (1.0 / m(2, 2));
}

}  // namespace eyrie
