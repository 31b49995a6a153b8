#pragma once

#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

namespace eyrie {

/// Whether a map of the ground into another frame is good enough to measure by and to be looked at: every corner of an
/// image of this size lies before the camera and is enlarged or shrunk by less than `most_unlike`.
bool isSoundMap(const cv::Matx33d& map, cv::Size image, double most_unlike);

}  // namespace eyrie
