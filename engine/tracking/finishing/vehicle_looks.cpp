#include "tracking/finishing/vehicle_looks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

bool isAt(const OrientedBox& vehicle, const OrientedBox& box) {
    const cv::Point2d off = vehicle.centre - box.centre;
    return std::hypot(off.x, off.y) < std::max(box.length, box.width) / 2;
}

}  // namespace

bool looksLikeOneOf(const std::vector<OrientedBox>& vehicles, const OrientedBox& box) {
    return std::any_of(vehicles.begin(), vehicles.end(), [&](const OrientedBox& v) { return isAt(v, box); });
}

VehicleLooks lookedLikeVehicle(const std::vector<TrackPath>& paths, const BoxesAt& vehicles_at) {
    VehicleLooks looks;
    std::optional<FrameIndex> asked;
    std::vector<OrientedBox> vehicles;
    visitByFrame(paths, [&](FrameIndex frame, const TrackPath& path, const PathState& state) {
        if (state.origin != StateOrigin::detected) return;
        if (asked != frame) {
            asked = frame;
            vehicles = vehicles_at(frame);
        }
        if (looksLikeOneOf(vehicles, state.box)) ++looks[path.id];
    });
    return looks;
}

}  // namespace eyrie
