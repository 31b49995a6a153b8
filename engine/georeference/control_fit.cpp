#include "georeference/control_fit.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace eyrie {
namespace {

constexpr double kWorstCondition =
    1e-5;  ///< second smallest singular value over the largest: below it points lie on a line

/// Moves points to their middle and makes their mean distance √2 (Hartley).
cv::Matx33d normalising(const std::vector<cv::Point2d>& points) {
    cv::Point2d middle(0, 0);
    for (const cv::Point2d& point : points) middle += point;
    middle /= static_cast<double>(points.size());
    double distance = 0;
    for (const cv::Point2d& point : points) distance += cv::norm(point - middle);
    const double scale = std::sqrt(2.0) * static_cast<double>(points.size()) / std::max(distance, 1e-12);
    return {scale, 0, -scale * middle.x, 0, scale, -scale * middle.y, 0, 0, 1};
}

cv::Point2d applied(const cv::Matx33d& map, cv::Point2d point) {
    const cv::Vec3d at = map * cv::Vec3d(point.x, point.y, 1);
    return {at[0] / at[2], at[1] / at[2]};
}

}  // namespace

std::optional<cv::Matx33d> projectiveMap(const std::vector<cv::Point2d>& image, const std::vector<cv::Point2d>& plane) {
    if (image.size() < static_cast<std::size_t>(kFewestControlPoints) || image.size() != plane.size())
        return std::nullopt;
    const cv::Matx33d from = normalising(image), to = normalising(plane);
    cv::Mat equations(static_cast<int>(2 * image.size()), 9, CV_64F, cv::Scalar(0));
    for (std::size_t i = 0; i < image.size(); ++i) {
        const cv::Point2d a = applied(from, image[i]), b = applied(to, plane[i]);
        const int row = static_cast<int>(2 * i);
        const double first[9] = {a.x, a.y, 1, 0, 0, 0, -b.x * a.x, -b.x * a.y, -b.x};
        const double second[9] = {0, 0, 0, a.x, a.y, 1, -b.y * a.x, -b.y * a.y, -b.y};
        for (int k = 0; k < 9; ++k) {
            equations.at<double>(row, k) = first[k];
            equations.at<double>(row + 1, k) = second[k];
        }
    }
    const cv::SVD svd(equations, cv::SVD::FULL_UV);
    // The null space must be one line: else more than one map fits.
    if (svd.w.at<double>(7) < kWorstCondition * svd.w.at<double>(0)) return std::nullopt;
    cv::Matx33d map;
    for (int k = 0; k < 9; ++k) map.val[k] = svd.vt.at<double>(8, k);
    map = to.inv() * map * from;
    // Positive where the points lie, all on one side of the horizon.
    double sign = 0;
    for (const cv::Point2d& point : image) {
        const double depth = map(2, 0) * point.x + map(2, 1) * point.y + map(2, 2);
        if (depth * sign < 0 || std::abs(depth) < 1e-15) return std::nullopt;
        sign = depth;
    }
    map = map * (sign < 0 ? -1.0 : 1.0);
    const double scale = std::abs(map(2, 2)) > 1e-12 ? std::abs(map(2, 2)) : 1;
    map = map * (1 / scale);
    if (std::abs(cv::determinant(map)) < 1e-15) return std::nullopt;
    return map;
}

std::vector<ControlFit> fitControlPoints(const std::vector<ControlPoint>& points, const CameraMotion& camera,
                                         const LocalPlane& plane, std::vector<std::string>* why_not) {
    std::vector<ControlPoint> left = points;
    std::stable_sort(left.begin(), left.end(),
                     [](const ControlPoint& a, const ControlPoint& b) { return a.frame < b.frame; });
    std::vector<ControlFit> fits;
    while (!left.empty()) {
        ControlFit fit;
        fit.frame = left.front().frame;
        std::vector<cv::Point2d> image, ground;
        std::vector<ControlPoint> others;
        for (const ControlPoint& point : left) {
            const auto there = camera.map(point.frame, fit.frame);
            if (point.frame != fit.frame && !there) {
                others.push_back(point);
                continue;
            }
            image.push_back(point.frame == fit.frame ? point.px : there->apply(point.px));
            ground.push_back(plane.metresOf(point.place));
        }
        left = std::move(others);
        const auto tell = [&](const std::string& what) {
            if (why_not != nullptr)
                why_not->push_back("from frame " + std::to_string(fit.frame) + " on there are " + what);
        };
        fit.points = static_cast<int>(image.size());
        if (fit.points < kFewestControlPoints) {
            tell(std::to_string(fit.points) + " control points that the registration connects; four are needed");
            continue;
        }
        const auto map = projectiveMap(image, ground);
        if (!map) {
            tell(std::to_string(fit.points) + " control points, but they lie on a line or contradict each other");
            continue;
        }
        fit.plane_from_image = *map;
        double squares = 0;
        for (std::size_t i = 0; i < image.size(); ++i)
            squares += std::pow(cv::norm(applied(*map, image[i]) - ground[i]), 2);
        fit.rms_m = std::sqrt(squares / static_cast<double>(image.size()));
        fits.push_back(fit);
    }
    return fits;
}

}  // namespace eyrie
