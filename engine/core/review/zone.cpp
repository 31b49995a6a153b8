#include "core/review/zone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace eyrie {
namespace {

constexpr double kSmallestArea = 1;  ///< px²
constexpr double kShortestLine = 1;  ///< px

/// Twice the area of a triangle; positive where c lies to the right of the way from a to b.
double side(cv::Point2d a, cv::Point2d b, cv::Point2d c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double distanceToEdge(cv::Point2d a, cv::Point2d b, cv::Point2d place) {
    const cv::Point2d along = b - a;
    const double squared = along.dot(along);
    const double share = squared > 0 ? std::clamp((place - a).dot(along) / squared, 0.0, 1.0) : 0;
    const cv::Point2d away = place - (a + along * share);
    return std::hypot(away.x, away.y);
}

bool edgesCross(cv::Point2d a, cv::Point2d b, cv::Point2d c, cv::Point2d d) {
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

bool crossesItself(const std::vector<cv::Point2d>& outline) {
    const std::size_t n = outline.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = i + 2; k < n; ++k) {
            if (edgesCross(outline[i], outline[(i + 1) % n], outline[k], outline[(k + 1) % n])) return true;
        }
    }
    return false;
}

}  // namespace

std::string faultOf(const Zone& zone) {
    const std::vector<cv::Point2d>& p = zone.points;
    if (std::any_of(p.begin(), p.end(), [](cv::Point2d at) { return !std::isfinite(at.x) || !std::isfinite(at.y); }))
        return "a point has no place";
    if (zone.shape != ZoneShape::area) {
        double length = 0;
        for (std::size_t i = 1; i < p.size(); ++i) length += std::hypot(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y);
        const std::string what = nameOf(zone.shape);
        if (p.size() < 2) return (zone.shape == ZoneShape::arrow ? "an " : "a ") + what + " needs two points or more";
        return length < kShortestLine ? "the " + what + " has no length: draw its points apart" : "";
    }
    if (p.size() < 3) return "an area needs three points or more";
    if (crossesItself(p)) return "the outline crosses itself: give its corners in their order around the area";
    double area = 0;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) area += side(p[0], p[i], p[i + 1]) / 2;
    return std::abs(area) < kSmallestArea ? "the zone has no area: its corners must not be on one line" : "";
}

const char* nameOf(ZoneShape shape) {
    constexpr std::array<const char*, 3> kNames = {"zone", "line", "arrow"};
    return kNames.at(static_cast<std::size_t>(shape));
}

std::vector<Zone> zonesOf(const std::map<int, StoredZone>& stored) {
    std::vector<Zone> zones;
    zones.reserve(stored.size());
    for (const auto& [id, zone] : stored) zones.push_back(zone.zone);
    return zones;
}

double distanceTo(const std::vector<cv::Point2d>& points, bool closed, cv::Point2d place) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < points.size(); ++i)
        least = std::min(least, distanceToEdge(points[i - 1], points[i], place));
    if (closed) least = std::min(least, distanceToEdge(points.back(), points.front(), place));
    return least;
}

bool isInside(const std::vector<cv::Point2d>& outline, cv::Point2d place) {
    bool inside = false;
    for (std::size_t i = 0, before = outline.size() - 1; i < outline.size(); before = i++) {
        const cv::Point2d a = outline[before], b = outline[i];
        if ((a.y > place.y) == (b.y > place.y)) continue;
        if (place.x < a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
}

int crossing(const std::vector<cv::Point2d>& line, cv::Point2d from, cv::Point2d to) {
    int sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        const cv::Point2d a = line[i - 1], b = line[i];
        // A place on the line itself counts as right of it, so that a step that ends there is not counted twice.
        const bool from_right = side(a, b, from) >= 0;
        const bool to_right = side(a, b, to) >= 0;
        if (from_right == to_right) continue;
        const bool a_right = side(from, to, a) >= 0;
        const bool b_right = side(from, to, b) >= 0;
        if (a_right != b_right) sum += to_right ? 1 : -1;
    }
    return std::clamp(sum, -1, 1);
}

}  // namespace eyrie
