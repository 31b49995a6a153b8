#pragma once

#include <Eigen/Core>

#include "core/geometry/homography.h"
#include "core/geometry/oriented_box.h"

namespace eyrie {

/// The Kalman filter of SORT: centre, area and aspect ratio of an upright box, with constant rates of the first three.
/// Its noise is that of the authors, whatever the size of the box.
class SortFilter {
 public:
    explicit SortFilter(const OrientedBox& first);

    /// One frame on. What was known moves with the ground first.
    void predict(const Homography& current_from_previous);
    void update(const OrientedBox& box);

    /// Upright; width and height are its length and width.
    OrientedBox box() const;
    /// px/frame over the ground.
    cv::Point2d velocity() const { return {state_(kRateX), state_(kRateY)}; }

 private:
    enum Entry { kX, kY, kArea, kAspect, kRateX, kRateY, kRateArea, kStateSize };
    static constexpr int kMeasured = 4;  ///< the first ones
    using Measurement = Eigen::Matrix<double, kMeasured, 1>;
    static Measurement measured(const OrientedBox& box);

    Eigen::Matrix<double, kStateSize, 1> state_;
    Eigen::Matrix<double, kStateSize, kStateSize> covariance_;
};

}  // namespace eyrie
