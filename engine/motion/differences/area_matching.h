#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace eyrie {

/// Where the pixels of an area are found in another picture.
struct AreaMatch {
    cv::Point2d shift{0, 0};  ///< px, from the one picture to the other
    double correlation = -1;  ///< −1 … 1, normalised, over the area's pixels
};

/// Looks for the best correlation of `pixels` of the picture `from` in the picture `to` (both CV_8UC1) within `reach`
/// px around a shift by `around`, as far as the area stays in the picture with a pixel around it. To a fraction of a
/// pixel. Nothing where it does not stay inside at `around` itself, is plain, or has more than 65,000 pixels.
std::optional<AreaMatch> matchArea(const std::vector<cv::Point>& pixels, const cv::Mat& from, const cv::Mat& to,
                                   cv::Point around, int reach);

}  // namespace eyrie
