#pragma once

#include <cmath>
#include <opencv2/core/types.hpp>

/// What paths between keyframes are held to, and what is reckoned with their vectors.
namespace eyrie::path_limits {

/// Length of a vector, in its unit.
inline double lengthOf(cv::Point2d v) {
    return std::hypot(v.x, v.y);
}

/// Its direction in radians, clockwise on screen from +x.
inline double angleOf(cv::Point2d v) {
    return std::atan2(v.y, v.x);
}

/// A tangent up to three times the slope keeps a cubic piece from running back (Fritsch and Carlson 1980).
constexpr double kLongestTangent = 3;
/// A piece shorter than this share of the one beside it tells it little: a pixel of its ends is a lot of its speed.
constexpr double kLeastShare = 1.0 / 3;
/// Between the heading and the direction of the path, radians.
constexpr double kLargestSlip = 0.6;
/// Curves that are driven: headings against the chord, and their difference, radians.
constexpr double kSharpestHalfTurn = 1.2;
constexpr double kLeastTurn = 0.1;

}  // namespace eyrie::path_limits
