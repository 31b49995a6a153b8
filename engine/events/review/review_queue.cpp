#include "events/review/review_queue.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "events/review/stop_groups.h"

namespace eyrie {

const char* nameOf(QueueGroup group) {
    constexpr std::array<const char*, 5> kNames = {"could not be searched", "lost in mid-picture", "rare", "unsure",
                                                   "others"};
    return kNames.at(static_cast<std::size_t>(group));
}

std::vector<bool> unsureEvents(const std::vector<Event>& events, const StoredTracks& run,
                               const CarriedVerdicts& carried, const std::map<int, Verdict>& verdicts,
                               const ReviewOptions& options) {
    std::vector<bool> unsure(events.size(), false);
    for (std::size_t i = 0; i < events.size(); ++i) {
        const auto verdict = verdicts.find(carried.of_event.at(i));
        if (verdict != verdicts.end() && verdict->second.judgement == Judgement::unsure) unsure[i] = true;
        for (const TrackId id : events[i].tracks) {
            const auto score = run.scores.find(id);
            if (score != run.scores.end() && score->second < options.unsure_score) unsure[i] = true;
        }
    }
    return unsure;
}

std::vector<QueueItem> reviewQueue(const std::vector<Event>& events, const std::vector<FrameSpan>& unsearched,
                                   const std::vector<bool>& unsure, const ReviewOptions& options) {
    std::map<EventKind, int> counts;
    for (const Event& event : events) ++counts[event.kind];
    struct Place {
        QueueItem item;
        int rarity = 0;
        FrameIndex frame = 0;
    };
    std::vector<Place> places;
    for (std::size_t i = 0; i < unsearched.size(); ++i) {
        places.push_back({{QueueGroup::not_searched, false, i}, 0, unsearched[i].first});
    }
    for (std::size_t i = 0; i < events.size(); ++i) {
        const Event& event = events[i];
        const int count = counts[event.kind];
        Place place{{QueueGroup::rest, true, i}, 0, event.first_frame};
        if (event.kind == EventKind::lost) {
            place.item.group = QueueGroup::lost;
        } else if (count <= options.rare) {
            place.item.group = QueueGroup::rare;
            place.rarity = count;
        } else if (unsure.at(i)) {
            place.item.group = QueueGroup::unsure;
        }
        places.push_back(place);
    }
    // Events of one stop stand where the most urgent of them would.
    const std::vector<std::optional<std::size_t>> stops = stopsOf(events);
    const auto urgency = [](const Place& place) { return std::tie(place.item.group, place.rarity); };
    std::map<std::size_t, Place> first_of_stop;
    const std::size_t first_event = unsearched.size();
    for (std::size_t i = 0; i < events.size(); ++i) {
        if (!stops[i]) continue;
        const Place& place = places[first_event + i];
        const auto [first, is_new] = first_of_stop.try_emplace(*stops[i], place);
        if (!is_new && urgency(place) < urgency(first->second)) first->second = place;
    }
    for (std::size_t i = 0; i < events.size(); ++i) {
        if (!stops[i]) continue;
        const Place& first = first_of_stop.at(*stops[i]);
        places[first_event + i].item.group = first.item.group;
        places[first_event + i].rarity = first.rarity;
    }
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return std::tie(a.item.group, a.rarity, a.frame) < std::tie(b.item.group, b.rarity, b.frame);
    });
    std::vector<QueueItem> queue;
    queue.reserve(places.size());
    for (const Place& place : places) queue.push_back(place.item);
    return queue;
}

}  // namespace eyrie
