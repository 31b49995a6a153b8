#pragma once

#include <vector>

#include "events/event.h"
#include "events/ground/ground_stretches.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// What events are computed from.
struct StoredTracks {
    std::vector<EventTrack> tracks;  ///< of the run's result, ascending ids
    Footage footage;                 ///< no frames where the run has none
    int unregistered = 0;            ///< frames that nothing connects with the one before
};

/// Reads a run's tracks and how its frames were registered. Throws Error(project).
StoredTracks readTracks(const RunStore& store, const RunRecord& run);

}  // namespace eyrie
