#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "events/review/carry_over.h"

namespace eyrie {

/// Why something stands where it does in the queue; the first come first.
enum class QueueGroup { not_searched, lost, rare, unsure, rest };
/// For people: "could not be searched", "lost in mid-picture", "rare", "unsure", "others".
const char* nameOf(QueueGroup group);

/// One thing that waits for a judgement.
struct QueueItem {
    QueueGroup group = QueueGroup::rest;
    bool is_event = true;   ///< false: a stretch that could not be searched
    std::size_t index = 0;  ///< in the list of events, or of stretches

    bool operator==(const QueueItem&) const = default;
};

/// Events to be looked at again: judged unsure, or of a vehicle whose track may be none (`unsure_score`).
std::vector<bool> unsureEvents(const std::vector<Event>& events, const StoredTracks& run,
                               const CarriedVerdicts& carried, const std::map<int, Verdict>& verdicts,
                               const ReviewOptions& options = {});

/// All events and stretches, each once, judged or not: what could not be searched, what was lost in mid-picture, kinds
/// of which there are at most `rare` (the rarest first), unsure ones, the rest; in time within each group. Those
/// lost are never rare. Events of one stop (stopsOf()) are in the group of the one that comes first. `unsure` is as
/// long as `events`. Order it when events change, not with every verdict, so that things stay where they are.
std::vector<QueueItem> reviewQueue(const std::vector<Event>& events, const std::vector<FrameSpan>& unsearched,
                                   const std::vector<bool>& unsure, const ReviewOptions& options = {});

}  // namespace eyrie
