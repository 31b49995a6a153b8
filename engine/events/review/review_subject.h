#pragma once

#include <vector>

#include "core/review/seen_frames.h"
#include "core/review/verdict.h"
#include "events/event.h"
#include "events/review/review_options.h"
#include "events/stored_events.h"

namespace eyrie {

/// What a verdict on an event of a run is about.
ReviewSubject subjectOf(const Event& event, const StoredTracks& run);
/// The same of a stretch that could not be searched.
ReviewSubject subjectOf(FrameSpan unsearched, const StoredTracks& run);

/// Frames of a run that could not be registered, those with little between them joined (`join_unsearched_s`),
/// ascending. Nothing is told across them, so only an operator can look.
std::vector<FrameSpan> unsearchedStretches(const Footage& footage, const ReviewOptions& options = {});

}  // namespace eyrie
