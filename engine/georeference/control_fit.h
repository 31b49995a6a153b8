#pragma once

#include <cstddef>
#include <opencv2/core/matx.hpp>
#include <optional>
#include <string>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/geometry/control_point.h"

namespace eyrie {

inline constexpr int kFewestControlPoints = 4;

/// How far the place of a control point is from where the fit puts it.
struct ControlResidual {
    std::size_t point = 0;  ///< its place in the list, from 0
    double metres = 0;
};

/// What control points of a stretch of frames that the registration connects say together.
struct ControlFit {
    FrameIndex frame = 0;          ///< that of its first point; the others were carried there
    cv::Matx33d plane_from_image;  ///< of that frame
    int points = 0;
    double rms_m = 0;  ///< distance of the points from where the fit puts them; 0 with four
    std::vector<ControlResidual> residuals;
    bool doubtful = false;  ///< the points are off by more than a fiftieth of the ground they span: one is wrong
    /// Of a doubtful fit the point without which the others agree well; nothing where none stands out, and with fewer
    /// than six, where any would.
    std::optional<std::size_t> suspect;
};

/// What is to be said against a fit, for people: "the points contradict each other by 12.3 m; without point 3 …"; empty
/// where nothing is. Points are numbered as the list has them, from 1.
std::string remarkOn(const ControlFit& fit);

/// The fits of all stretches that have at least four points in general position. `why_not` tells of the others, for
/// people, a sentence each.
std::vector<ControlFit> fitControlPoints(const std::vector<ControlPoint>& points, const CameraMotion& camera,
                                         const LocalPlane& plane, std::vector<std::string>* why_not = nullptr);

/// The projective map that takes points of an image to points of a plane, by least squares; nothing where three of four
/// lie on a line or nearly so, or where it turns the picture inside out.
std::optional<cv::Matx33d> projectiveMap(const std::vector<cv::Point2d>& image, const std::vector<cv::Point2d>& plane);

}  // namespace eyrie
