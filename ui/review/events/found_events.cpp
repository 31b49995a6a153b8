#include "review/events/found_events.h"

#include <utility>

namespace eyrie::ui {

std::shared_ptr<const FoundEvents> findAndOrder(const std::shared_ptr<const StoredTracks>& run,
                                                const EventOptions& options, const std::map<int, Verdict>& verdicts) {
    return inOrder(run, findEvents(run->tracks, run->footage, options), verdicts);
}

std::shared_ptr<const FoundEvents> inOrder(const std::shared_ptr<const StoredTracks>& run, std::vector<Event> events,
                                           const std::map<int, Verdict>& verdicts) {
    auto found = std::make_shared<FoundEvents>();
    found->run = run;
    found->events = std::move(events);
    found->unsearched = unsearchedStretches(run->footage);
    found->carried = carryOver(verdicts, found->events, found->unsearched, *run);
    const std::vector<bool> unsure = unsureEvents(found->events, *run, found->carried, verdicts);
    found->queue = reviewQueue(found->events, found->unsearched, unsure);
    return found;
}

int listedKindAt(const FoundEvents& found, std::size_t position) {
    const Event* event = found.eventAt(position);
    return event != nullptr ? static_cast<int>(event->kind) : kEventKinds;
}

}  // namespace eyrie::ui
