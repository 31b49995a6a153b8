#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "core/values/frame.h"

namespace eyrie::test {

/// A ground plane with smooth random texture that is a function of real coordinates, so that pictures of it under any
/// homography are exact: nothing is resampled.
class TexturedGround {
 public:
    explicit TexturedGround(unsigned seed, double contrast = 1) : contrast_(contrast) {
        std::mt19937 random(seed);
        lattice_.resize(kSide * kSide);
        for (float& value : lattice_) value = float(random() % 20001) / 10000.0F - 1.0F;
    }

    /// Grey level at a place of the ground.
    double at(double x, double y) const {
        double sum = 0;
        for (const double cell : {3.1, 6.7, 15.3, 41.0}) {
            sum += std::min(26.0, 14 * std::sqrt(cell / 3)) * smooth(x / cell + 7 * cell, y / cell + 3 * cell);
        }
        return 118 + contrast_ * sum;
    }

    /// What a camera sees. `ground_from_picture` maps pixels to the ground.
    cv::Mat picture(cv::Size size, const cv::Matx33d& ground_from_picture, double noise, unsigned seed) const {
        cv::Mat result(size, CV_8UC1);
        std::mt19937 random(seed);
        std::normal_distribution<double> normal(0, 1);
        const auto& m = ground_from_picture;
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const double w = m(2, 0) * x + m(2, 1) * y + m(2, 2);
                const double value =
                    at((m(0, 0) * x + m(0, 1) * y + m(0, 2)) / w, (m(1, 0) * x + m(1, 1) * y + m(1, 2)) / w);
                result.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(value + noise * normal(random));
            }
        }
        return result;
    }

 private:
    static constexpr int kSide = 128;

    float lattice(int x, int y) const {
        return lattice_[std::size_t(((y % kSide) + kSide) % kSide * kSide + ((x % kSide) + kSide) % kSide)];
    }
    /// Cubic B-spline over the lattice: twice continuously differentiable.
    double smooth(double x, double y) const {
        const double fx = std::floor(x);
        const double fy = std::floor(y);
        double wx[4];
        double wy[4];
        spline(x - fx, wx);
        spline(y - fy, wy);
        double sum = 0;
        for (int j = 0; j < 4; ++j) {
            for (int i = 0; i < 4; ++i) {
                sum += wx[i] * wy[j] * double(lattice(int(fx) + i - 1, int(fy) + j - 1));
            }
        }
        return 2 * sum;
    }
    static void spline(double t, double* w) {
        w[0] = (1 - t) * (1 - t) * (1 - t) / 6;
        w[1] = (3 * t * t * t - 6 * t * t + 4) / 6;
        w[2] = (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6;
        w[3] = t * t * t / 6;
    }

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
