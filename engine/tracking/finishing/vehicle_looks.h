#pragma once

#include <map>
#include <vector>

#include "tracking/finishing/track_finishing.h"

namespace eyrie {

/// In how many of its detected states each track was taken for a whole vehicle by the classifier; tracks that never
/// were are left out.
using VehicleLooks = std::map<TrackId, int>;

/// Whether one of the boxes that a classifier took for whole vehicles lies at a box.
bool looksLikeOneOf(const std::vector<OrientedBox>& vehicles, const OrientedBox& box);

/// Asks for each frame once.
VehicleLooks lookedLikeVehicle(const std::vector<TrackPath>& paths, const BoxesAt& vehicles_at);

}  // namespace eyrie
