#include "scene/traffic/path.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/portable_math.h"

namespace eyrie {
namespace {

constexpr double kStep = 0.5;       ///< metres between the vertices of rounded paths
constexpr double kSameWay = 1e-9;   ///< by which unit tangents of a straight part may differ
constexpr double kBendReach = 1.5;  ///< m before and after, over which a bend is measured

double norm(cv::Point2d v) {
    return std::sqrt(v.x * v.x + v.y * v.y);
}

cv::Point2d unitOf(cv::Point2d v) {
    const double length = norm(v);
    return length > 0 ? v * (1 / length) : cv::Point2d(1, 0);
}

void appendLine(std::vector<cv::Point2d>& points, cv::Point2d to) {
    if (points.empty()) {
        points.push_back(to);
        return;
    }
    const cv::Point2d from = points.back();
    const double length = norm(to - from);
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / kStep)));
    if (length < 1e-9) return;
    for (int i = 1; i <= pieces; ++i) points.push_back(from + (to - from) * (static_cast<double>(i) / pieces));
}

}  // namespace

Path::Path(std::vector<cv::Point2d> points) {
    for (const cv::Point2d& point : points) {
        if (points_.empty() || norm(point - points_.back()) > 1e-9) points_.push_back(point);
    }
    if (points_.size() < 2) throw Error(ErrorKind::internal, "A path needs two different points.");
    lengths_.push_back(0);
    for (std::size_t i = 1; i < points_.size(); ++i)
        lengths_.push_back(lengths_.back() + norm(points_[i] - points_[i - 1]));
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const cv::Point2d before = points_[i == 0 ? 0 : i - 1];
        const cv::Point2d after = points_[std::min(i + 1, points_.size() - 1)];
        directions_.push_back(unitOf(after - before));
    }
    turns_.resize(points_.size());
    std::size_t turn = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        turn = std::max(turn, i + 1);
        while (turn < points_.size() && norm(directions_[turn] - directions_[i]) <= kSameWay) ++turn;
        turns_[i] = turn;
    }
}

Path Path::rounded(const std::vector<cv::Point2d>& waypoints, double radius) {
    std::vector<cv::Point2d> points;
    appendLine(points, waypoints.front());
    for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) {
        const cv::Point2d in = unitOf(waypoints[i] - waypoints[i - 1]);
        const cv::Point2d out = unitOf(waypoints[i + 1] - waypoints[i]);
        const double turn = portable::arcTangent(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y);
        if (std::abs(turn) < 1e-6) continue;
        const double half_tangent = portable::tangent(std::abs(turn) / 2);
        const double room =
            std::min(norm(waypoints[i] - waypoints[i - 1]), norm(waypoints[i + 1] - waypoints[i])) * 0.49;
        const double used_radius = std::min(radius, room / half_tangent);
        const cv::Point2d start = waypoints[i] - in * (used_radius * half_tangent);
        appendLine(points, start);
        const double side = turn > 0 ? 1 : -1;
        const cv::Point2d centre = start + rightOf(in) * (side * used_radius);
        const int pieces = std::max(2, static_cast<int>(std::ceil(used_radius * std::abs(turn) / kStep)));
        for (int k = 1; k <= pieces; ++k) {
            const double angle = std::abs(turn) * k / pieces;
            points.push_back(centre + in * (used_radius * portable::sine(angle)) -
                             rightOf(in) * (side * used_radius * portable::cosine(angle)));
        }
    }
    appendLine(points, waypoints.back());
    return Path(std::move(points));
}

Path Path::shifted(double right) const {
    std::vector<cv::Point2d> moved;
    for (std::size_t i = 0; i < points_.size(); ++i) moved.push_back(points_[i] + rightOf(directions_[i]) * right);
    return Path(std::move(moved));
}

Path Path::part(double from, double to) const {
    std::vector<cv::Point2d> kept{position(from)};
    for (std::size_t i = 0; i < points_.size(); ++i) {
        if (lengths_[i] > from && lengths_[i] < to) kept.push_back(points_[i]);
    }
    kept.push_back(position(to));
    return Path(std::move(kept));
}

Path Path::reversed() const {
    return Path(std::vector<cv::Point2d>(points_.rbegin(), points_.rend()));
}

std::size_t Path::pieceAt(double s) const {
    const auto next = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, s);
    return static_cast<std::size_t>(next - lengths_.begin()) - 1;
}

cv::Point2d Path::position(double s) const {
    const std::size_t i = pieceAt(s);
    const double share = (s - lengths_[i]) / (lengths_[i + 1] - lengths_[i]);
    return points_[i] + (points_[i + 1] - points_[i]) * share;
}

cv::Point2d Path::direction(double s) const {
    const std::size_t i = pieceAt(s);
    const double share = std::clamp((s - lengths_[i]) / (lengths_[i + 1] - lengths_[i]), 0.0, 1.0);
    return unitOf(directions_[i] * (1 - share) + directions_[i + 1] * share);
}

cv::Point2d Path::beside(double s, double right) const {
    return position(s) + rightOf(direction(s)) * right;
}

double Path::curvature(double s) const {
    const cv::Point2d before = direction(s - kBendReach);
    const cv::Point2d after = direction(s + kBendReach);
    return (before.x * after.y - before.y * after.x) / (2 * kBendReach);
}

bool Path::isStraight(double from, double to) const {
    return turns_[pieceAt(from - kBendReach)] > pieceAt(to + kBendReach) + 1;
}

double Path::nearest(cv::Point2d point, double from, double to) const {
    const auto first =
        static_cast<std::size_t>(std::lower_bound(lengths_.begin(), lengths_.end(), from) - lengths_.begin());
    const auto end =
        static_cast<std::size_t>(std::upper_bound(lengths_.begin(), lengths_.end(), to) - lengths_.begin());
    if (first >= end) return from;
    const auto distance = [&](std::size_t i) {
        const cv::Point2d offset = point - points_[i];
        return offset.x * offset.x + offset.y * offset.y;
    };
    const auto search = [&](std::size_t low, std::size_t high, std::size_t step) {
        std::size_t best = low;
        double least = distance(low);
        for (std::size_t i = low + step; i < high; i += step) {
            const double here = distance(i);
            if (!(here < least)) continue;
            best = i;
            least = here;
        }
        return best;
    };
    // Streets bend gently: the nearest of every eighth vertex is beside the nearest of all.
    constexpr std::size_t kStride = 8;
    const std::size_t coarse = search(first, end, kStride);
    return lengths_[search(std::max(first + kStride, coarse) - kStride, std::min(end, coarse + kStride + 1), 1)];
}

std::vector<cv::Point2d> stripAlong(const Path& path, double from, double to, double right_from, double right_to) {
    std::vector<cv::Point2d> outline;
    const int pieces = std::max(1, static_cast<int>(std::ceil((to - from) / 1.0)));
    for (int i = 0; i <= pieces; ++i) outline.push_back(path.beside(from + (to - from) * i / pieces, right_from));
    for (int i = pieces; i >= 0; --i) outline.push_back(path.beside(from + (to - from) * i / pieces, right_to));
    return outline;
}

std::vector<cv::Point2d> rectangleAt(cv::Point2d centre, cv::Point2d direction, double length, double width) {
    const cv::Point2d along = direction * (length / 2);
    const cv::Point2d across = rightOf(direction) * (width / 2);
    return {centre - along - across, centre + along - across, centre + along + across, centre - along + across};
}

}  // namespace eyrie
