#pragma once

#include <vector>

#include "events/event_csv.h"
#include "events/review/carry_over.h"

namespace eyrie::cli {

/// Events of a run with what was said about them.
struct JudgedEvents {
    std::vector<Event> events;
    std::vector<int> numbers;              ///< of each event among all of the run, from 1
    std::vector<const Verdict*> verdicts;  ///< of each event, null for none
    std::vector<LeftVerdict> left;
    bool any = false;  ///< whether anything was said about this video
};

/// The events as a table, and how many there are of each kind. No `moment`: nobody knows when the video was taken.
void printEvents(const JudgedEvents& judged, const StoredTracks& stored, const FrameMoment& moment);
/// The verdicts that could not be carried over, with the reasons; nothing where there are none.
void printLeft(const JudgedEvents& judged, const ReviewSet& review);

/// What people corrected of the tracks, and what became of it in this run; nothing where they did not.
void printCorrections(const CorrectedTracks& corrected, const ReviewSet& review);

}  // namespace eyrie::cli
