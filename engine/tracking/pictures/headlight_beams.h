#pragma once

#include <vector>

#include "tracking/finishing/track_paths.h"
#include "tracking/pictures/silhouette_search.h"

namespace eyrie {

/// Takes what headlights throw on the ground ahead of vehicles out of the front of their boxes, as much of it as looks
/// show to be in each track's. Nothing where few tracks have lights, as by day.
void takeOutBeams(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks);

}  // namespace eyrie
