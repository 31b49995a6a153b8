#include "review/events/found_events.h"

#include <utility>

namespace eyrie::ui {

std::shared_ptr<const FoundEvents> findAndOrder(const std::shared_ptr<const StoredTracks>& run,
                                                const EventOptions& options, const std::map<int, Verdict>& verdicts,
                                                const std::vector<Zone>& zones) {
    return inOrder(run, searchTracks(run->tracks, run->footage, options, zones), verdicts, zones);
}

std::shared_ptr<const FoundEvents> inOrder(const std::shared_ptr<const StoredTracks>& run, TrackFindings findings,
                                           const std::map<int, Verdict>& verdicts, const std::vector<Zone>& zones) {
    auto found = std::make_shared<FoundEvents>();
    found->run = run;
    found->events = std::move(findings.events);
    found->event_speeds = std::move(findings.event_speeds);
    found->zones = zones;
    found->unsearched = unsearchedStretches(run->footage);
    found->carried = carryOver(verdicts, found->events, found->unsearched, *run, zones);
    const std::vector<bool> unsure = unsureEvents(found->events, *run, found->carried, verdicts);
    found->doings = std::make_shared<const DoingsByTrack>(doingsOf(*run, found->events, findings.speeds));
    found->queue = reviewQueue(found->events, found->unsearched, unsure);
    return found;
}

int listedKindAt(const FoundEvents& found, std::size_t position) {
    const Event* event = found.eventAt(position);
    return event != nullptr ? static_cast<int>(event->kind) : kEventKinds;
}

}  // namespace eyrie::ui
