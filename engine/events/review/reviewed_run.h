#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "events/event_search.h"
#include "events/review/carry_over.h"
#include "store/project/project_file.h"

namespace eyrie {

/// The events of a run with all that was said about its video: what lists, reports and clips begin with.
struct ReviewedRun {
    RunRecord run;
    StoredTracks tracks;
    std::vector<Event> events;  ///< all of them; the number of an event is its place here, from 1
    std::vector<FrameSpan> unsearched;
    std::vector<Zone> zones;  ///< that were watched
    ReviewSet review;
    CarriedVerdicts carried;

    /// The verdict on an event, or on a stretch that could not be searched; null for none.
    const Verdict* verdictOn(std::size_t event) const;
    const Verdict* verdictOnStretch(std::size_t stretch) const;
};

/// What of it is wanted.
struct EventChoice {
    EventOptions options;
    ReviewOptions review;
    std::optional<std::vector<Zone>> zones;  ///< nothing: those that the project keeps for the video
    std::vector<EventKind> kinds;            ///< none: all
    std::vector<Judgement> judgements;       ///< none: all
    std::vector<std::string> tags;           ///< one of these at least; none: with any or without
    std::vector<int> numbers;                ///< of events, from 1, as all of the run are counted; none: all
    bool uncorrected = false;                ///< of the run's own tracks

    /// Whether an event of this kind (nothing: a stretch that could not be searched) with this verdict, null for none,
    /// and this number, 0 for none, is wanted.
    bool wants(const std::optional<EventKind>& kind, const Verdict* verdict, int number) const;
};

/// Reads a run and searches it for events. Zones must be without fault. Throws Error(project).
ReviewedRun readReviewedRun(ProjectFile& project, const RunRecord& run, const EventChoice& choice);

}  // namespace eyrie
