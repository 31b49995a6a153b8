#pragma once

#include "core/geometry/local_plane.h"
#include "core/values/ids.h"

namespace eyrie {

/// A place that a person found in a picture and on the earth.
struct ControlPoint {
    FrameIndex frame = 0;
    cv::Point2d px;  ///< in that frame
    GeoPoint place;  ///< WGS 84, degrees

    bool operator==(const ControlPoint&) const = default;
};

}  // namespace eyrie
