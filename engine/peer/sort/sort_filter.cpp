#include "peer/sort/sort_filter.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

constexpr double kSmallestArea = 1;  // px²

/// Whether a map of one frame can be trusted near a point: finite, no leap in scale.
bool isPlausible(const Homography& map, cv::Point2d point) {
    const double scale = map.scaleAt(point);
    const cv::Point2d mapped = map.apply(point);
    return std::isfinite(mapped.x) && std::isfinite(mapped.y) && scale > 0.2 && scale < 5;
}

}  // namespace

SortFilter::Measurement SortFilter::measured(const OrientedBox& box) {
    return {box.centre.x, box.centre.y, box.area(), box.length / box.width};
}

SortFilter::SortFilter(const OrientedBox& first) {
    state_.setZero();
    state_.head<kMeasured>() = measured(first);
    covariance_.setZero();
    covariance_.diagonal() << 10, 10, 10, 10, 1e4, 1e4, 1e4;  // nothing is known of the rates
}

void SortFilter::predict(const Homography& current_from_previous) {
    const cv::Point2d centre(state_(kX), state_(kY));
    if (isPlausible(current_from_previous, centre)) {
        const cv::Point2d moved = current_from_previous.apply(centre);
        const cv::Point2d rate = current_from_previous.applyToVector(centre, velocity());
        const double scale = current_from_previous.scaleAt(centre);
        state_(kX) = moved.x;
        state_(kY) = moved.y;
        state_(kRateX) = rate.x;
        state_(kRateY) = rate.y;
        state_(kArea) *= scale * scale;
        state_(kRateArea) *= scale * scale;
    }
    if (state_(kArea) + state_(kRateArea) < kSmallestArea) state_(kRateArea) = 0;
    Eigen::Matrix<double, kStateSize, kStateSize> transition;
    transition.setIdentity();
    transition(kX, kRateX) = transition(kY, kRateY) = transition(kArea, kRateArea) = 1;
    state_ = (transition * state_).eval();
    covariance_ = (transition * covariance_ * transition.transpose()).eval();
    Eigen::Matrix<double, kStateSize, 1> noise;
    noise << 1, 1, 1, 1, 0.01, 0.01, 1e-4;
    covariance_.diagonal() += noise;
}

void SortFilter::update(const OrientedBox& box) {
    const Eigen::Vector4d noise(1, 1, 10, 10);
    Eigen::Matrix4d innovation = covariance_.topLeftCorner<kMeasured, kMeasured>();
    innovation.diagonal() += noise;
    const Eigen::Matrix<double, kStateSize, kMeasured> gain = covariance_.leftCols<kMeasured>() * innovation.inverse();
    state_ += gain * (measured(box) - state_.head<kMeasured>());
    covariance_ -= (gain * covariance_.topRows<kMeasured>()).eval();
}

OrientedBox SortFilter::box() const {
    const double area = std::max(state_(kArea), kSmallestArea);
    const double length = std::sqrt(area * std::max(state_(kAspect), 0.01));
    return {{state_(kX), state_(kY)}, length, area / length, 0};
}

}  // namespace eyrie
