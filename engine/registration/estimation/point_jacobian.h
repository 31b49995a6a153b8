#pragma once

#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

namespace eyrie {

/// A projective map about one point: the point's image and the Jacobian there. Single precision serves positions within
/// a picture to 1e-4 px.
struct PointJacobian {
    cv::Point2f point;
    float xx, xy, yx, yy;

    PointJacobian(const cv::Matx33d& m, cv::Point2f p) {
        const double inverse = 1.0 / (m(2, 0) * p.x + m(2, 1) * p.y + m(2, 2));
        const double u = (m(0, 0) * p.x + m(0, 1) * p.y + m(0, 2)) * inverse;
        const double v = (m(1, 0) * p.x + m(1, 1) * p.y + m(1, 2)) * inverse;
        point = {static_cast<float>(u), static_cast<float>(v)};
        xx = static_cast<float>((m(0, 0) - u * m(2, 0)) * inverse);
        xy = static_cast<float>((m(0, 1) - u * m(2, 1)) * inverse);
        yx = static_cast<float>((m(1, 0) - v * m(2, 0)) * inverse);
        yy = static_cast<float>((m(1, 1) - v * m(2, 1)) * inverse);
    }

    cv::Point2f vector(cv::Point2f d) const { return {xx * d.x + xy * d.y, yx * d.x + yy * d.y}; }
};

}  // namespace eyrie
