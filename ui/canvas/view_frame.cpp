#include "canvas/view_frame.h"

#include <algorithm>

namespace eyrie::ui {

namespace {

/// `states` by ascending id.
const TrackState* stateAmong(const std::vector<TrackState>& states, TrackId id) {
    const auto found = std::lower_bound(states.begin(), states.end(), id,
                                        [](const TrackState& state, TrackId wanted) { return state.id < wanted; });
    return found != states.end() && found->id == id ? &*found : nullptr;
}

}  // namespace

const TrackState* stateOf(const ViewFrame& frame, TrackId track) {
    const TrackState* state = frame.result ? stateAmong(frame.result->tracks, track) : nullptr;
    return state != nullptr ? state : stateAmong(frame.doubtful, track);
}

}  // namespace eyrie::ui
