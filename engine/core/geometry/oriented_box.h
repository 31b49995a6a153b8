#pragma once

#include <array>
#include <opencv2/core/types.hpp>

namespace eyrie {

/// A rectangle turned into the direction of motion. Pixel coordinates: x right, y down, integers are pixel centres.
struct OrientedBox {
    cv::Point2d centre{0, 0};
    double length = 0;   ///< px, along `heading`
    double width = 0;    ///< px, across `heading`
    double heading = 0;  ///< radians, clockwise on screen from +x

    double area() const { return length * width; }
    /// Unit vector along the heading.
    cv::Point2d direction() const;
    /// Rear left, front left, front right, rear right as seen when looking along the heading on screen.
    std::array<cv::Point2d, 4> corners() const;
    /// `point` in the box's own axes: x along the heading, y to the right of it, origin at the centre; px.
    cv::Point2d toBox(cv::Point2d point) const;
    /// Inverse of `toBox`.
    cv::Point2d toImage(cv::Point2d in_box) const;
    /// Whether `point` lies inside the box grown by `margin` px on every side; the border belongs to it.
    bool contains(cv::Point2d point, double margin = 0) const;
    /// Smallest upright box (heading 0) around this one.
    OrientedBox upright() const;
    /// The same centre and heading with length and width multiplied.
    OrientedBox scaled(double length_factor, double width_factor) const;
};

/// Area in px² that two boxes share, by polygon clipping.
double intersectionArea(const OrientedBox& a, const OrientedBox& b);

/// Overlap |A ∩ B| / |A ∪ B| in [0, 1] (Teutsch eq. 6.1, 7.1); 0 when either box is empty.
double overlap(const OrientedBox& a, const OrientedBox& b);

/// Share of the smaller box's area that lies inside the other, in [0, 1].
double containment(const OrientedBox& a, const OrientedBox& b);

/// Whether a box means a place: one of them holds the middle of the other, or they overlap by a fifth.
bool atPlace(const OrientedBox& box, const OrientedBox& place);

/// Smallest box with the given heading around all `points`; empty at the origin when there is none.
template <class Points>
OrientedBox boxAround(const Points& points, double heading);

/// Smallest box with `a`'s heading that holds both boxes (Teutsch §5.5.1: fusion by union).
OrientedBox unionBox(const OrientedBox& a, const OrientedBox& b);

/// Area in px² of the part of the box that lies in an image of this size (pixel centres 0 … size − 1, edges ± 0.5).
double areaInImage(const OrientedBox& box, cv::Size image);

}  // namespace eyrie

#include "core/geometry/oriented_box_inl.h"
