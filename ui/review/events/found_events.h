#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "events/event_search.h"
#include "events/review/review_queue.h"
#include "events/stored_events.h"
#include "review/tracks/track_doings.h"

namespace eyrie::ui {

/// What is to be judged in a run, in the order of the queue: events, and stretches that could not be searched. Made in
/// the background, then never changed.
struct FoundEvents {
    std::shared_ptr<const StoredTracks> run;
    std::vector<Event> events;
    std::vector<std::optional<SpeedRange>> event_speeds;  ///< as TrackFindings has them
    std::vector<std::optional<std::size_t>> stops;        ///< by event: which stop it is of, see stopsOf()
    std::vector<FrameSpan> unsearched;
    std::vector<Zone> zones;  ///< that were watched
    std::vector<QueueItem> queue;
    CarriedVerdicts carried;  ///< verdicts when it was made
    std::shared_ptr<const DoingsByTrack> doings;
    std::weak_ptr<const FoundEvents> former;  ///< the list of the same run that this one takes the place of, if any
    /// By place in the queue: the place there of the same thing, found as verdicts find their events; nothing: it is
    /// new. Empty without a former list.
    std::vector<std::optional<std::size_t>> place_in_former;

    /// The event at a place of the queue; null for a stretch that could not be searched.
    const Event* eventAt(std::size_t position) const {
        const QueueItem& item = queue.at(position);
        return item.is_event ? &events.at(item.index) : nullptr;
    }
    /// The event's number among all of the run, from 1: the same in the window, on the command line and in reports.
    /// Stretches that could not be searched have none.
    std::optional<int> numberAt(std::size_t position) const {
        const QueueItem& item = queue.at(position);
        return item.is_event ? std::optional(static_cast<int>(item.index) + 1) : std::nullopt;
    }
    FrameSpan framesAt(std::size_t position) const {
        const Event* event = eventAt(position);
        return event != nullptr ? FrameSpan{event->first_frame, event->last_frame}
                                : unsearched.at(queue.at(position).index);
    }
    /// The stop that the event at a place of the queue tells of, with others; nothing: none.
    std::optional<std::size_t> stopAt(std::size_t position) const {
        const QueueItem& item = queue.at(position);
        return item.is_event && item.index < stops.size() ? stops[item.index] : std::nullopt;
    }
    /// The frame to look at.
    FrameIndex frameAt(std::size_t position) const {
        const Event* event = eventAt(position);
        return event != nullptr ? event->frame : framesAt(position).first;
    }
    /// How fast its tracks were while it lasted, m/s; nothing where that is not known.
    std::optional<SpeedRange> speedsAt(std::size_t position) const {
        const QueueItem& item = queue.at(position);
        return item.is_event && item.index < event_speeds.size() ? event_speeds[item.index] : std::nullopt;
    }
    ReviewSubject subjectAt(std::size_t position) const {
        const Event* event = eventAt(position);
        return event != nullptr ? subjectOf(*event, *run) : subjectOf(framesAt(position), *run);
    }
};

/// Searches stored tracks for events and gives them the verdicts they have. `former`: what was found in the same run
/// when it was not done yet or its tracks were not yet corrected, so that tracks and their numbers may have been
/// others; null: nothing.
std::shared_ptr<const FoundEvents> findAndOrder(const std::shared_ptr<const StoredTracks>& run,
                                                const EventOptions& options, const std::map<int, Verdict>& verdicts,
                                                const std::vector<Zone>& zones = {},
                                                const std::shared_ptr<const FoundEvents>& former = nullptr);
/// The same with what a search told.
std::shared_ptr<const FoundEvents> inOrder(const std::shared_ptr<const StoredTracks>& run, TrackFindings findings,
                                           const std::map<int, Verdict>& verdicts, const std::vector<Zone>& zones = {},
                                           const std::shared_ptr<const FoundEvents>& former = nullptr);

/// Kinds as they are listed: those of events by their numbers, and behind them what could not be searched.
inline constexpr int kListedKinds = kEventKinds + 1;
int listedKindAt(const FoundEvents& found, std::size_t position);

}  // namespace eyrie::ui
