#pragma once

#include <vector>

#include "core/review/seen_frames.h"
#include "events/event_options.h"
#include "events/stored_events.h"

namespace eyrie {

/// The stretches in which something may move, ascending and apart: where a vehicle drives over the ground, with a
/// second before and after it, and where nobody can know, because a frame could not be registered. What stands still
/// the whole time is left out. `ground` must be that of the run's footage; `min_score`: tracks of a lower score do not
/// count.
std::vector<FrameSpan> movingSpans(const StoredTracks& run, const GroundStretches& ground,
                                   const EventOptions& options = {}, double min_score = 0);

}  // namespace eyrie
