#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "core/values/frame.h"

namespace eyrie::test {

/// A ground plane with smooth random texture that is a function of real coordinates, so that pictures of it under any
/// homography are exact: nothing is resampled.
class TexturedGround {
 public:
    explicit TexturedGround(unsigned seed, double contrast = 1);

    /// Grey level at a place of the ground.
    double at(double x, double y) const;
    /// What a camera sees. `ground_from_picture` maps pixels to the ground.
    cv::Mat picture(cv::Size size, const cv::Matx33d& ground_from_picture, double noise, unsigned seed) const;

 private:
    float lattice(int x, int y) const;
    double smooth(double x, double y) const;

    double contrast_;
    std::vector<float> lattice_;
};

/// Shift, turn about the picture's centre and zoom.
inline cv::Matx33d cameraMotion(cv::Size size, double dx, double dy, double degrees, double zoom = 1) {
    const double cx = (size.width - 1) / 2.0;
    const double cy = (size.height - 1) / 2.0;
    const double c = zoom * std::cos(degrees * CV_PI / 180);
    const double s = zoom * std::sin(degrees * CV_PI / 180);
    return {c, -s, cx - c * cx + s * cy + dx, s, c, cy - s * cx - c * cy + dy, 0, 0, 1};
}

/// Mean distance between two maps over a 9×9 grid on the picture, px.
inline double gridError(const cv::Matx33d& a, const cv::Matx33d& b, cv::Size size) {
    double sum = 0;
    for (int j = 0; j <= 8; ++j) {
        for (int i = 0; i <= 8; ++i) {
            const cv::Vec3d p((size.width - 1) * i / 8.0, (size.height - 1) * j / 8.0, 1);
            const cv::Vec3d u = a * p;
            const cv::Vec3d v = b * p;
            sum += std::hypot(u[0] / u[2] - v[0] / v[2], u[1] / u[2] - v[1] / v[2]);
        }
    }
    return sum / 81;
}

inline Frame frameOf(int index, const cv::Mat& gray) {
    Frame frame;
    frame.index = index;
    frame.time_us = index * 40000;
    frame.gray = gray;
    return frame;
}

}  // namespace eyrie::test
