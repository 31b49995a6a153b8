#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"
#include "core/values/track_state.h"

namespace eyrie {

/// One line of a result or ground truth file: an object in a frame. What every box format is converted to at the
/// border.
struct BoxRecord {
    FrameIndex frame = 0;
    std::optional<int> id;  ///< empty for detections
    OrientedBox box;
    std::string object_class;    ///< car, truck, bus, van, vehicle, motorcycle, bicycle, person, other; may be empty
    bool ignore = false;         ///< ground truth: counts neither way
    double score = 1;            ///< results: higher is surer
    cv::Point2d velocity{0, 0};  ///< px/frame relative to the ground; 0 where unknown
    std::optional<StateOrigin> origin;  ///< results: where the box came from, as far as it is known
};

/// All boxes of a file, by frame.
using BoxesByFrame = std::map<FrameIndex, std::vector<BoxRecord>>;

/// Takes boxes one by one, each with its frame.
using BoxVisitor = std::function<void(FrameIndex, const BoxRecord&)>;
/// Hands boxes over one by one, in ascending frames, so that they need not all be held at once.
using VisitBoxes = std::function<void(const BoxVisitor&)>;

/// The word for where a box came from, as tables have it; empty where it is not known.
std::string originText(const BoxRecord& record);

/// Whether all boxes lie along the image's axes, so that there may be no headings in them.
bool allUpright(const BoxesByFrame& boxes);

/// Whether a class counts as vehicle (Teutsch §7.2): car, truck, bus, van, vehicle.
bool isVehicleClass(const std::string& object_class);

}  // namespace eyrie
