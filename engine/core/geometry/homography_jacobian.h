#pragma once

#include <cmath>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

namespace eyrie {

/// What a projective map does to the surroundings of a point: its first-order part there.
class HomographyJacobian {
 public:
    HomographyJacobian(const cv::Matx33d& m, cv::Point2d p) {
        const double w = m(2, 0) * p.x + m(2, 1) * p.y + m(2, 2);
        point_ = {(m(0, 0) * p.x + m(0, 1) * p.y + m(0, 2)) / w, (m(1, 0) * p.x + m(1, 1) * p.y + m(1, 2)) / w};
        jacobian_ = {(m(0, 0) - point_.x * m(2, 0)) / w, (m(0, 1) - point_.x * m(2, 1)) / w,
                     (m(1, 0) - point_.y * m(2, 0)) / w, (m(1, 1) - point_.y * m(2, 1)) / w};
    }

    /// Where the point goes.
    cv::Point2d point() const { return point_; }
    /// Displacement of a direction, px.
    cv::Point2d vector(cv::Point2d v) const {
        const cv::Matx22d& j = jacobian_;
        return {j(0, 0) * v.x + j(0, 1) * v.y, j(1, 0) * v.x + j(1, 1) * v.y};
    }
    /// Enlargement: square root of the Jacobian's determinant.
    double scale() const {
        const cv::Matx22d& j = jacobian_;
        return std::sqrt(std::abs(j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0)));
    }
    /// The direction `heading` (radians) after the map.
    double turned(double heading) const {
        const cv::Point2d v = vector({std::cos(heading), std::sin(heading)});
        return std::atan2(v.y, v.x);
    }

 private:
    cv::Point2d point_;
    cv::Matx22d jacobian_;
};

}  // namespace eyrie
