#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/oriented_box.h"

namespace eyrie {

template <class Points>
OrientedBox boxAround(const Points& points, double heading) {
    OrientedBox axes;
    axes.heading = heading;
    double along_min = std::numeric_limits<double>::max();
    double along_max = std::numeric_limits<double>::lowest();
    double across_min = along_min;
    double across_max = along_max;
    bool any = false;
    for (const auto& point : points) {
        const cv::Point2d p = axes.toBox(cv::Point2d(point.x, point.y));
        along_min = std::min(along_min, p.x);
        along_max = std::max(along_max, p.x);
        across_min = std::min(across_min, p.y);
        across_max = std::max(across_max, p.y);
        any = true;
    }
    if (!any) return axes;
    OrientedBox box = axes;
    box.centre = axes.toImage({(along_min + along_max) / 2, (across_min + across_max) / 2});
    box.length = along_max - along_min;
    box.width = across_max - across_min;
    return box;
}

}  // namespace eyrie
