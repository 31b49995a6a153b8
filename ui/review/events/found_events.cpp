#include "review/events/found_events.h"

#include <utility>

#include "events/review/stop_groups.h"

namespace eyrie::ui {

namespace {

/// Which place of the former list has the same thing, as if everything in it had a verdict.
std::vector<std::optional<std::size_t>> placesIn(const FoundEvents& former, const FoundEvents& found) {
    std::map<int, Verdict> listed;
    for (std::size_t place = 0; place < former.queue.size(); ++place) {
        const int id = static_cast<int>(place) + 1;
        listed[id].id = id;
        listed[id].subject = former.subjectAt(place);
    }
    const CarriedVerdicts carried = carryOver(listed, found.events, found.unsearched, *found.run, found.zones);
    std::vector<std::optional<std::size_t>> places;
    for (const QueueItem& item : found.queue) {
        const int id = (item.is_event ? carried.of_event : carried.of_stretch).at(item.index);
        places.push_back(id > 0 ? std::optional(static_cast<std::size_t>(id) - 1) : std::nullopt);
    }
    return places;
}

}  // namespace

std::shared_ptr<const FoundEvents> findAndOrder(const std::shared_ptr<const StoredTracks>& run,
                                                const EventOptions& options, const std::map<int, Verdict>& verdicts,
                                                const std::vector<Zone>& zones,
                                                const std::shared_ptr<const FoundEvents>& former) {
    return inOrder(run, searchTracks(run->tracks, run->footage, options, zones), verdicts, zones, former);
}

std::shared_ptr<const FoundEvents> inOrder(const std::shared_ptr<const StoredTracks>& run, TrackFindings findings,
                                           const std::map<int, Verdict>& verdicts, const std::vector<Zone>& zones,
                                           const std::shared_ptr<const FoundEvents>& former) {
    auto found = std::make_shared<FoundEvents>();
    found->run = run;
    found->events = std::move(findings.events);
    found->event_speeds = std::move(findings.event_speeds);
    found->stops = stopsOf(found->events);
    found->zones = zones;
    found->unsearched = unsearchedStretches(run->footage);
    found->carried = carryOver(verdicts, found->events, found->unsearched, *run, zones);
    const std::vector<bool> unsure = unsureEvents(found->events, *run, found->carried, verdicts);
    found->doings = std::make_shared<const DoingsByTrack>(doingsOf(*run, found->events, findings.speeds));
    found->queue = reviewQueue(found->events, found->unsearched, unsure);
    found->former = former;
    if (former) found->place_in_former = placesIn(*former, *found);
    return found;
}

int listedKindAt(const FoundEvents& found, std::size_t position) {
    const Event* event = found.eventAt(position);
    return event != nullptr ? static_cast<int>(event->kind) : kEventKinds;
}

}  // namespace eyrie::ui
