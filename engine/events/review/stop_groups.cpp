#include "events/review/stop_groups.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace eyrie {
namespace {

/// In the order in which they happen; nothing for other kinds.
std::optional<int> stepOf(EventKind kind) {
    switch (kind) {
        case EventKind::stops:
            return 0;
        case EventKind::stands:
            return 1;
        case EventKind::starts:
            return 2;
        default:
            return std::nullopt;
    }
}

}  // namespace

std::vector<std::optional<std::size_t>> stopsOf(const std::vector<Event>& events) {
    std::map<TrackId, std::vector<std::size_t>> of_track;
    for (std::size_t i = 0; i < events.size(); ++i)
        if (stepOf(events[i].kind) && events[i].tracks.size() == 1) of_track[events[i].tracks.front()].push_back(i);
    std::vector<std::optional<std::size_t>> stops(events.size());
    std::size_t next = 0;
    for (auto& [track, steps] : of_track) {
        const auto order = [&](std::size_t i) { return std::tuple(events[i].first_frame, *stepOf(events[i].kind)); };
        std::stable_sort(steps.begin(), steps.end(), [&](std::size_t a, std::size_t b) { return order(a) < order(b); });
        for (std::size_t k = 1; k < steps.size(); ++k) {
            const Event& former = events[steps[k - 1]];
            const Event& later = events[steps[k]];
            // If it stands from another frame on than it stopped in, it moved in between.
            const bool goes_on = *stepOf(former.kind) < *stepOf(later.kind) &&
                                 (later.kind == EventKind::stands ? later.first_frame == former.first_frame
                                                                  : later.first_frame > former.last_frame);
            if (!goes_on) continue;
            auto& stop = stops[steps[k - 1]];
            if (!stop) stop = next++;
            stops[steps[k]] = stop;
        }
    }
    return stops;
}

}  // namespace eyrie
