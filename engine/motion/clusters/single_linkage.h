#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/values/motion_vector.h"
#include "core/values/scale_slope.h"

namespace eyrie {

/// When two motion vectors belong together. Both conditions must hold at once.
struct Linkage {
    double along = 10;             ///< px, half axis of the ellipse along the mean motion of the two; > 0
    double across = 5;             ///< px, half axis across it; > 0
    double velocity_floor = 0.04;  ///< px/frame, velocities may always differ by this
    double velocity_share = 0.05;  ///< … or by this share of the mean speed
    double smallest = 0;           ///< px below which no half axis falls where the slope makes it smaller
    double smallest_far = 0;       ///< … if it is more, where ground lies farther away than at the slope's centre
    ScaleSlope slope = {};         ///< the half axes are those at its centre

    /// Sets both half axes, px at the slope's centre, with the smallest that either may be anywhere.
    void reach(double along_px, double across_px, double smallest_px);
    /// px below which no half axis falls at a place.
    double smallestAt(cv::Point2d place) const;
    /// The linkage at a place, as one that is the same everywhere.
    Linkage at(cv::Point2d place) const;
    /// The farthest that any two of the vectors may lie apart, px.
    double reachAmong(const std::vector<MotionVector>& vectors) const;
    bool joins(const MotionVector& a, const MotionVector& b) const;

 private:
    double smallestWhere(double scale_factor) const {
        return scale_factor < 1 ? std::max(smallest, smallest_far) : smallest;
    }
    std::pair<double, double> halfAxesAt(cv::Point2d place) const;
};

/// Positions of the vectors; what is not finite, in place or velocity, lies nowhere.
std::vector<cv::Point2f> positionsOf(const std::vector<MotionVector>& vectors);

/// Single-linkage clustering (Teutsch §4.2): the connected parts of the graph whose edges are the joined pairs. Returns
/// for every vector the number of its cluster; clusters are numbered from 0 in the order of their first vector.
/// Vectors with a position that is not finite stand alone. A spatial grid and union-find keep it near linear.
std::vector<int> singleLinkage(const std::vector<MotionVector>& vectors, const Linkage& linkage);

}  // namespace eyrie
