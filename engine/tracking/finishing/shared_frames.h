#pragma once

#include "tracking/finishing/track_paths.h"
#include "tracking/ground_motion.h"

namespace eyrie {

/// Calls `visit(a, b)` with where both are and how they move, for every frame that both tracks have, in order.
template <typename Visit>
void forSharedFrames(const TrackPath& a, const TrackPath& b, Visit visit) {
    auto at_a = a.states.begin();
    auto at_b = b.states.begin();
    while (at_a != a.states.end() && at_b != b.states.end()) {
        if (at_a->first < at_b->first) {
            ++at_a;
        } else if (at_b->first < at_a->first) {
            ++at_b;
        } else {
            visit(movingOf(at_a->second), movingOf(at_b->second));
            ++at_a;
            ++at_b;
        }
    }
}

}  // namespace eyrie
