#pragma once

#include <vector>

#include "tracking/finishing/track_paths.h"
#include "tracking/silhouettes/silhouette_search.h"

namespace eyrie {

/// Whether so many tracks throw light ahead of them that it is dark.
bool driveWithHeadlights(const std::vector<SilhouetteLook>& looks);

/// Takes what headlights throw on the ground ahead of vehicles out of the front of their boxes, as much of it as looks
/// show to be in each track's.
void takeOutBeams(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks);

}  // namespace eyrie
