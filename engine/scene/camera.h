#pragma once

#include <cstdint>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

namespace eyrie {

/// World coordinates of scenes: metres, x right and y down as on a map, z up; the ground plane is z = 0.

/// A pinhole camera at one moment.
struct CameraPose {
    cv::Point3d position;                ///< m
    cv::Matx33d camera_from_world_turn;  ///< rows: image right, image down, viewing direction
    double focal_px = 1000;
    cv::Point2d principal{0, 0};  ///< px

    /// Pixel of a world point that lies before the camera.
    cv::Point2d project(cv::Point3d point) const;
    /// Distance of a world point along the viewing direction, m.
    double depth(cv::Point3d point) const;
    /// Maps ground points (m) to pixels exactly; of any scale.
    cv::Matx33d imageFromGround() const;
};

/// Where the camera looks at one moment of its path.
struct CameraKey {
    double frame = 0;
    cv::Point2d target;   ///< m: ground point on the optical axis
    double height = 400;  ///< m above the ground
    double heading = 0;   ///< radians: direction on the map of the image's +x
    double tilt = 0;      ///< radians from straight down, towards the image's top; below about 60°
    double focal_px = 1000;
};

/// Band-limited random shake: slow swaying and fast vibration of the viewing direction.
struct CameraShake {
    double sway_px = 0;       ///< deviation of the slow part (0.2–1 Hz), px at the image centre
    double vibration_px = 0;  ///< deviation of the fast part (2–9 Hz), px
    double roll = 0;          ///< deviation of the turn about the optical axis, radians
    std::uint32_t seed = 1;
};

/// A smooth way through the keys, with shake.
struct CameraPath {
    std::vector<CameraKey> keys;  ///< at least one, ascending frames; constant before the first and after the last
    CameraShake shake;
    cv::Size image_size;
    double frame_rate_hz = 25;

    /// The pose at a moment; fractions of frames serve motion blur.
    CameraPose at(double frame) const;
};

/// Smallest map rectangle (m) with everything on the ground that the camera sees in frames 0 … count − 1.
cv::Rect2d groundSeen(const CameraPath& path, int frame_count);

}  // namespace eyrie
