#include "core/geometry/homography.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <string>

#include "core/error.h"
#include "core/geometry/homography_jacobian.h"

namespace eyrie {

cv::Point2d Homography::apply(cv::Point2d point) const {
    const auto& m = matrix;
    const double w = m(2, 0) * point.x + m(2, 1) * point.y + m(2, 2);
    return {(m(0, 0) * point.x + m(0, 1) * point.y + m(0, 2)) / w,
            (m(1, 0) * point.x + m(1, 1) * point.y + m(1, 2)) / w};
}

cv::Point2d Homography::applyToVector(cv::Point2d point, cv::Point2d vector) const {
    return HomographyJacobian(matrix, point).vector(vector);
}

Homography Homography::inverse() const {
    bool invertible = false;
    cv::Matx33d back = matrix.inv(cv::DECOMP_LU, &invertible);
    if (!invertible || std::abs(back(2, 2)) < 1e-12) {
        throw Error(ErrorKind::internal, "homography from frame " + std::to_string(from_frame) + " to " +
                                             std::to_string(to_frame) + " cannot be inverted");
    }
    Homography result;
    result.matrix = back * (1.0 / back(2, 2));
    result.from_frame = to_frame;
    result.to_frame = from_frame;
    return result;
}

double Homography::scaleAt(cv::Point2d point) const {
    return HomographyJacobian(matrix, point).scale();
}

double Homography::turned(cv::Point2d point, double heading) const {
    return HomographyJacobian(matrix, point).turned(heading);
}

Homography operator*(const Homography& c_from_b, const Homography& b_from_a) {
    if (b_from_a.to_frame != c_from_b.from_frame) {
        throw Error(ErrorKind::internal, "homographies do not meet: frame " + std::to_string(b_from_a.to_frame) +
                                             " is not frame " + std::to_string(c_from_b.from_frame));
    }
    Homography product;
    product.matrix = c_from_b.matrix * b_from_a.matrix;
    product.matrix = product.matrix * (1.0 / product.matrix(2, 2));
    product.from_frame = b_from_a.from_frame;
    product.to_frame = c_from_b.to_frame;
    return product;
}

}  // namespace eyrie
