#pragma once

#include <opencv2/core/mat.hpp>

namespace eyrie {

/// Means of the cells of a picture (CV_8UC1) that is divided into `cells.width` × `cells.height` equal ones, parts of
/// pixels counting as such, rounded; CV_8UC1. What cv::resize(…, INTER_AREA) gives, several times as fast where a cell
/// is no whole number of pixels. There are at most as many cells as pixels on either side, and at least one.
cv::Mat cellMeans(const cv::Mat& gray, cv::Size cells);

}  // namespace eyrie
