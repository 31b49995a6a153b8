#pragma once

#include <opencv2/core/matx.hpp>
#include <optional>
#include <string>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/geometry/control_point.h"

namespace eyrie {

inline constexpr int kFewestControlPoints = 4;

/// What control points of a stretch of frames that the registration connects say together.
struct ControlFit {
    FrameIndex frame = 0;          ///< that of its first point; the others were carried there
    cv::Matx33d plane_from_image;  ///< of that frame
    int points = 0;
    double rms_m = 0;  ///< distance of the points from where the fit puts them; 0 with four
};

/// The fits of all stretches that have at least four points in general position. `why_not` tells of the others, for
/// people, a sentence each.
std::vector<ControlFit> fitControlPoints(const std::vector<ControlPoint>& points, const CameraMotion& camera,
                                         const LocalPlane& plane, std::vector<std::string>* why_not = nullptr);

/// The projective map that takes points of an image to points of a plane, by least squares; nothing where three of four
/// lie on a line or nearly so, or where it turns the picture inside out.
std::optional<cv::Matx33d> projectiveMap(const std::vector<cv::Point2d>& image, const std::vector<cv::Point2d>& plane);

}  // namespace eyrie
