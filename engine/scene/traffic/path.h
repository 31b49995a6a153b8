#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

namespace eyrie {

/// A curve on the ground by arc length, metres; x right, y down as on a map. "Right" is as seen along the curve.
class Path {
 public:
    Path() = default;
    /// Through the points in straight lines.
    explicit Path(std::vector<cv::Point2d> points);
    /// Straight between the waypoints, its corners rounded with arcs of at most this radius (m).
    static Path rounded(const std::vector<cv::Point2d>& waypoints, double radius);
    /// The curve `right` metres to its right (negative: left).
    Path shifted(double right) const;
    /// The part between two arc lengths.
    Path part(double from, double to) const;
    Path reversed() const;

    double length() const { return lengths_.empty() ? 0 : lengths_.back(); }
    /// Beyond its ends the curve goes on straight.
    cv::Point2d position(double s) const;
    /// Unit tangent, turning evenly along the pieces.
    cv::Point2d direction(double s) const;
    /// The point `right` metres to the right of the curve at `s`.
    cv::Point2d beside(double s, double right) const;
    /// Bend in 1/m, positive to the right.
    double curvature(double s) const;
    /// Whether nothing between two arc lengths bends enough for anybody to slow down; quickly told.
    bool isStraight(double from, double to) const;
    /// Arc length of the nearest vertex in [from, to]; the curve's vertices are about half a metre apart when rounded.
    double nearest(cv::Point2d point, double from, double to) const;
    double nearest(cv::Point2d point) const { return nearest(point, 0, length()); }
    const std::vector<cv::Point2d>& points() const { return points_; }

 private:
    std::size_t pieceAt(double s) const;

    std::vector<cv::Point2d> points_;
    std::vector<double> lengths_;          ///< arc length up to each point
    std::vector<cv::Point2d> directions_;  ///< unit tangent at each point
    std::vector<std::size_t> turns_;       ///< the first later point whose tangent is another one
};

/// The right-hand normal of a direction when y points down.
inline cv::Point2d rightOf(cv::Point2d direction) {
    return {-direction.y, direction.x};
}

/// The area between `right_from` and `right_to` metres beside the path for arc lengths in [from, to].
std::vector<cv::Point2d> stripAlong(const Path& path, double from, double to, double right_from, double right_to);

/// A rectangle: its centre, extents along and across `direction` (unit vector), metres.
std::vector<cv::Point2d> rectangleAt(cv::Point2d centre, cv::Point2d direction, double length, double width);

}  // namespace eyrie
