#include "peer/sort/sort_tracker.h"

#include <algorithm>

#include "tracking/association/best_assignment.h"

namespace eyrie {

void SortOptions::describe(const ParameterDeclarer& declare) {
    declare.real("peer.min_overlap", min_overlap, 0.01, 1,
                 {"", "Overlap that a box must have with the prediction of its track.", "Bewley et al. 2016"});
    declare.integer(
        "peer.min_hits", min_hits, 1, 1000,
        {"frames", "Boxes in a row that confirm a track. Larger: fewer false tracks.", "Bewley et al. 2016"});
    declare.integer("peer.max_age", max_age, 0, 1000,
                    {"frames", "A track without a box for longer than this ends.", "Bewley et al. 2016"});
}

std::vector<int> SortTracker::associate(const std::vector<OrientedBox>& boxes) const {
    std::vector<WeightedPair> pairs;
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
        const OrientedBox predicted = tracks_[t].filter.box();
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            const double shared = overlap(predicted, boxes[b]);
            if (shared >= options_.min_overlap) pairs.push_back({static_cast<int>(t), static_cast<int>(b), shared});
        }
    }
    std::vector<int> track_of(boxes.size(), -1);
    for (const int chosen : bestAssignment(pairs)) {
        const WeightedPair& pair = pairs[static_cast<std::size_t>(chosen)];
        track_of[static_cast<std::size_t>(pair.column)] = pair.row;
    }
    return track_of;
}

TrackState SortTracker::stateOf(const Track& track) {
    TrackState state;
    state.id = track.id;
    state.box = track.filter.box();
    state.velocity = track.filter.velocity();
    state.origin = track.missed == 0 ? StateOrigin::detected : StateOrigin::predicted;
    state.status = !track.confirmed    ? TrackStatus::tentative
                   : track.missed == 0 ? TrackStatus::confirmed
                                       : TrackStatus::coasting;
    state.age = track.age;
    state.hits = track.hits;
    state.score = static_cast<double>(track.hits) / (track.age + 1);
    return state;
}

std::vector<TrackState> SortTracker::next(const std::vector<OrientedBox>& boxes,
                                          const Homography& current_from_previous) {
    std::vector<OrientedBox> upright;
    for (const OrientedBox& box : boxes) {
        if (box.area() > 0) upright.push_back(box.upright());
    }
    for (Track& track : tracks_) {
        track.filter.predict(current_from_previous);
        ++track.age;
        ++track.missed;
    }
    const std::vector<int> track_of = associate(upright);
    for (std::size_t b = 0; b < upright.size(); ++b) {
        if (track_of[b] < 0) continue;
        Track& track = tracks_[static_cast<std::size_t>(track_of[b])];
        track.filter.update(upright[b]);
        track.in_row = track.missed == 1 ? track.in_row + 1 : 1;
        track.missed = 0;
        ++track.hits;
        track.confirmed = track.confirmed || track.in_row >= options_.min_hits;
    }
    for (std::size_t b = 0; b < upright.size(); ++b) {
        if (track_of[b] >= 0) continue;
        Track track{next_id_++, SortFilter(upright[b])};
        track.hits = track.in_row = 1;
        track.confirmed = options_.min_hits <= 1;
        tracks_.push_back(track);
    }
    std::erase_if(tracks_, [&](const Track& track) { return track.missed > options_.max_age; });
    std::vector<TrackState> states;
    for (const Track& track : tracks_) states.push_back(stateOf(track));
    return states;
}

}  // namespace eyrie
