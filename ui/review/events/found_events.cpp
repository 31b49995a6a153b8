#include "review/events/found_events.h"

#include <utility>

namespace eyrie::ui {

std::shared_ptr<const FoundEvents> findAndOrder(const std::shared_ptr<const StoredTracks>& run,
                                                const EventOptions& options, const std::map<int, Verdict>& verdicts,
                                                const std::vector<Zone>& zones) {
    TrackFindings found = searchTracks(run->tracks, run->footage, options, zones);
    return inOrder(run, std::move(found.events), verdicts, zones, found.speeds);
}

std::shared_ptr<const FoundEvents> inOrder(const std::shared_ptr<const StoredTracks>& run, std::vector<Event> events,
                                           const std::map<int, Verdict>& verdicts, const std::vector<Zone>& zones,
                                           const std::map<TrackId, SpeedRange>& speeds) {
    auto found = std::make_shared<FoundEvents>();
    found->run = run;
    found->events = std::move(events);
    found->zones = zones;
    found->unsearched = unsearchedStretches(run->footage);
    found->carried = carryOver(verdicts, found->events, found->unsearched, *run, zones);
    const std::vector<bool> unsure = unsureEvents(found->events, *run, found->carried, verdicts);
    found->doings = std::make_shared<const DoingsByTrack>(doingsOf(*run, found->events, speeds));
    found->queue = reviewQueue(found->events, found->unsearched, unsure);
    return found;
}

int listedKindAt(const FoundEvents& found, std::size_t position) {
    const Event* event = found.eventAt(position);
    return event != nullptr ? static_cast<int>(event->kind) : kEventKinds;
}

}  // namespace eyrie::ui
