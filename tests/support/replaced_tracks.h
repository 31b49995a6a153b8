#pragma once

#include <utility>
#include <vector>

#include "store/runs/run_store.h"

namespace eyrie::test {

/// A run gets other tracks, of which nothing but their states is known, and what was left out of them.
inline void replaceTrackStates(RunStore& store, int run_id, const std::vector<TrackFrame>& states,
                               const std::vector<std::pair<FrameIndex, DroppedState>>& dropped = {}) {
    TracksOfRun tracks;
    tracks.states = [&](const TracksOfRun::StateVisitor& visitor) {
        for (const TrackFrame& state : states) visitor(state.frame, state.state);
    };
    tracks.dropped = [&](const TracksOfRun::DropVisitor& visitor) {
        for (const auto& [frame, state] : dropped) visitor(frame, state);
    };
    store.replaceTracks(run_id, tracks);
}

}  // namespace eyrie::test
