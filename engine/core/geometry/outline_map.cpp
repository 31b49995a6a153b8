#include "core/geometry/outline_map.h"

namespace eyrie {

std::array<cv::Point2d, 4> outlineOf(cv::Size size) {
    const double right = size.width - 0.5, bottom = size.height - 0.5;
    return {{{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}};
}

cv::Matx33d outlineOnto(const std::array<cv::Point2d, 4>& q, cv::Size size) {
    const cv::Point2d sum = q[0] - q[1] + q[2] - q[3];
    const cv::Point2d right = q[1] - q[2];
    const cv::Point2d lower = q[3] - q[2];
    const double area = right.cross(lower);
    const double g = sum.cross(lower) / area;
    const double h = right.cross(sum) / area;
    const cv::Point2d a = q[1] - q[0] + g * q[1];
    const cv::Point2d b = q[3] - q[0] + h * q[3];
    const cv::Matx33d from_square(a.x, b.x, q[0].x, a.y, b.y, q[0].y, g, h, 1);
    const cv::Matx33d to_square(1.0 / size.width, 0, 0.5 / size.width, 0, 1.0 / size.height, 0.5 / size.height, 0, 0,
                                1);
    return from_square * to_square;
}

}  // namespace eyrie
