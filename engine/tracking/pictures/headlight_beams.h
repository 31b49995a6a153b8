#pragma once

#include <map>
#include <vector>

#include "core/evidence/light_finding.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/silhouettes/silhouette_search.h"

namespace eyrie {

/// Whether so many tracks throw light ahead of them that it is dark: a quarter of them, the fewer the darker the
/// pictures are.
bool driveWithHeadlights(const std::vector<SilhouetteLook>& looks);

/// What headlights were found to light.
struct BeamFinding {
    int vehicles = 0;                  ///< that have a beam, surely; 0 where none was taken out
    std::map<TrackId, BoxTrim> trims;  ///< what was taken out of which boxes
};

/// Takes what headlights throw on the ground ahead of vehicles out of the front of their boxes, as much of it as looks
/// show to be in each track's, and, the darker it is, what they usually light ahead and on both sides besides. Nothing
/// where few tracks have lights, as by day.
BeamFinding takeOutBeams(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks);

}  // namespace eyrie
