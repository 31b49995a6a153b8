#pragma once

#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

#include "core/values/ids.h"

namespace eyrie {

/// Projective map of the ground plane between two frames of one video (Teutsch §4.2). Carries the frames it joins, so
/// that products of maps that do not meet are refused.
struct Homography {
    cv::Matx33d matrix = cv::Matx33d::eye();  ///< (x', y', w') = matrix · (x, y, 1); matrix(2, 2) = 1
    FrameIndex from_frame = 0;                ///< frame the points are taken from
    FrameIndex to_frame = 0;                  ///< frame the points are taken to
    int inliers = 0;                          ///< corners that agree; 0 for products and inverses
    double rms_px = 0;                        ///< root mean square residual of the inliers, px

    cv::Point2d apply(cv::Point2d point) const;
    /// Displacement of a direction at a point by the local (first-order) map, px.
    cv::Point2d applyToVector(cv::Point2d point, cv::Point2d vector) const;
    /// The map back. Throws Error(internal) when the matrix is singular.
    Homography inverse() const;
    /// Local enlargement at a point: square root of the Jacobian's determinant.
    double scaleAt(cv::Point2d point) const;
    /// Local turn at a point: the direction `heading` (radians) after the map.
    double turned(cv::Point2d point, double heading) const;
};

/// c_from_a = c_from_b * b_from_a; throws Error(internal) unless b_from_a.to_frame == c_from_b.from_frame.
Homography operator*(const Homography& c_from_b, const Homography& b_from_a);

}  // namespace eyrie
