#include "core/geometry/oriented_box.h"

#include <vector>

namespace eyrie {
namespace {

using Polygon = std::vector<cv::Point2d>;

double cross(cv::Point2d a, cv::Point2d b) {
    return a.x * b.y - a.y * b.x;
}

double areaOf(const Polygon& polygon) {
    double doubled = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) doubled += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return std::abs(doubled) / 2;
}

/// Keeps the part of `polygon` to the right of the edge from `a` to `b` (inside, for our corner order on screen).
Polygon clippedByEdge(const Polygon& polygon, cv::Point2d a, cv::Point2d b) {
    Polygon kept;
    kept.reserve(polygon.size() + 2);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const cv::Point2d p = polygon[i];
        const cv::Point2d q = polygon[(i + 1) % polygon.size()];
        const double side_p = cross(b - a, p - a);
        const double side_q = cross(b - a, q - a);
        if (side_p >= 0) kept.push_back(p);
        if ((side_p > 0 && side_q < 0) || (side_p < 0 && side_q > 0)) {
            kept.push_back(p + (q - p) * (side_p / (side_p - side_q)));
        }
    }
    return kept;
}

Polygon clipped(Polygon polygon, const std::array<cv::Point2d, 4>& clip) {
    for (std::size_t i = 0; i < 4 && !polygon.empty(); ++i)
        polygon = clippedByEdge(polygon, clip[i], clip[(i + 1) % 4]);
    return polygon;
}

}  // namespace

cv::Point2d OrientedBox::direction() const {
    return {std::cos(heading), std::sin(heading)};
}

std::array<cv::Point2d, 4> OrientedBox::corners() const {
    const double l = length / 2;
    const double w = width / 2;
    const cv::Point2d d = direction();
    const auto at = [&](double x, double y) {
        return cv::Point2d(centre.x + x * d.x - y * d.y, centre.y + x * d.y + y * d.x);
    };
    return {at(-l, -w), at(l, -w), at(l, w), at(-l, w)};
}

cv::Point2d OrientedBox::toBox(cv::Point2d point) const {
    const cv::Point2d d = direction();
    const cv::Point2d r = point - centre;
    return {r.x * d.x + r.y * d.y, -r.x * d.y + r.y * d.x};
}

cv::Point2d OrientedBox::toImage(cv::Point2d in_box) const {
    const cv::Point2d d = direction();
    return {centre.x + in_box.x * d.x - in_box.y * d.y, centre.y + in_box.x * d.y + in_box.y * d.x};
}

bool OrientedBox::contains(cv::Point2d point, double margin) const {
    const cv::Point2d p = toBox(point);
    return std::abs(p.x) <= length / 2 + margin && std::abs(p.y) <= width / 2 + margin;
}

OrientedBox OrientedBox::upright() const {
    const cv::Point2d d = direction();
    const double c = std::abs(d.x);
    const double s = std::abs(d.y);
    return {centre, length * c + width * s, length * s + width * c, 0};
}

OrientedBox OrientedBox::scaled(double length_factor, double width_factor) const {
    return {centre, length * length_factor, width * width_factor, heading};
}

double intersectionArea(const OrientedBox& a, const OrientedBox& b) {
    const cv::Point2d apart = a.centre - b.centre;
    const double reach = (std::hypot(a.length, a.width) + std::hypot(b.length, b.width)) / 2;
    if (std::hypot(apart.x, apart.y) > reach) return 0;
    const auto corners = a.corners();
    return areaOf(clipped(Polygon(corners.begin(), corners.end()), b.corners()));
}

double overlap(const OrientedBox& a, const OrientedBox& b) {
    if (!(a.area() > 0) || !(b.area() > 0)) return 0;
    const double shared = intersectionArea(a, b);
    return std::clamp(shared / (a.area() + b.area() - shared), 0.0, 1.0);
}

double containment(const OrientedBox& a, const OrientedBox& b) {
    const double smaller = std::min(a.area(), b.area());
    if (!(smaller > 0)) return 0;
    return std::clamp(intersectionArea(a, b) / smaller, 0.0, 1.0);
}

bool atPlace(const OrientedBox& box, const OrientedBox& place) {
    constexpr double kSamePlace = 0.2;
    return box.contains(place.centre) || place.contains(box.centre) || overlap(box, place) >= kSamePlace;
}

OrientedBox unionBox(const OrientedBox& a, const OrientedBox& b) {
    std::vector<cv::Point2d> points;
    for (const auto& corner : a.corners()) points.push_back(corner);
    for (const auto& corner : b.corners()) points.push_back(corner);
    return boxAround(points, a.heading);
}

double areaInImage(const OrientedBox& box, cv::Size image) {
    const OrientedBox whole{{(image.width - 1) / 2.0, (image.height - 1) / 2.0},
                            static_cast<double>(image.width),
                            static_cast<double>(image.height),
                            0};
    return intersectionArea(box, whole);
}

}  // namespace eyrie
