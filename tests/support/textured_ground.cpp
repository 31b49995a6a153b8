#include "support/textured_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace eyrie::test {
namespace {

constexpr int kSide = 128;

using Spline = std::array<double, 4>;

Spline splineAt(double t) {
    return {(1 - t) * (1 - t) * (1 - t) / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
            (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6};
}

int wrapped(int i) {
    return (i % kSide + kSide) % kSide;
}

}  // namespace

TexturedGround::TexturedGround(unsigned seed, double contrast) : contrast_(contrast) {
    std::mt19937 random(seed);
    lattice_.resize(kSide * kSide);
    for (float& value : lattice_) value = float(random() % 20001) / 10000.0F - 1.0F;
}

double TexturedGround::at(double x, double y) const {
    double sum = 0;
    for (const double cell : {3.1, 6.7, 15.3, 41.0}) {
        sum += std::min(26.0, 14 * std::sqrt(cell / 3)) * smooth(x / cell + 7 * cell, y / cell + 3 * cell);
    }
    return 118 + contrast_ * sum;
}

cv::Mat TexturedGround::picture(cv::Size size, const cv::Matx33d& ground_from_picture, double noise,
                                unsigned seed) const {
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

float TexturedGround::lattice(int x, int y) const {
    return lattice_[std::size_t(wrapped(y) * kSide + wrapped(x))];
}

/// Cubic B-spline over the lattice: twice continuously differentiable.
double TexturedGround::smooth(double x, double y) const {
    const double fx = std::floor(x);
    const double fy = std::floor(y);
    const Spline wx = splineAt(x - fx);
    const Spline wy = splineAt(y - fy);
    double sum = 0;
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) {
            sum += wx[i] * wy[j] * double(lattice(int(fx) + int(i) - 1, int(fy) + int(j) - 1));
        }
    }
    return 2 * sum;
}

}  // namespace eyrie::test
