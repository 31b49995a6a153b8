#pragma once

#include <array>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

namespace eyrie {

/// The corners of an image, half a pixel outside the centres of its pixels: upper left, then clockwise; px.
std::array<cv::Point2d, 4> outlineOf(cv::Size size);

/// The projective map of that outline onto four corners in the same order (Heckbert's closed form over the unit
/// square). For a convex quadrilateral its denominator is positive all over the picture, and 1 at the upper left
/// corner.
cv::Matx33d outlineOnto(const std::array<cv::Point2d, 4>& quad, cv::Size size);

}  // namespace eyrie
