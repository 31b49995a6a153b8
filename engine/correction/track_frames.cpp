#include "correction/track_frames.h"

#include <algorithm>

namespace eyrie {
namespace {

constexpr std::size_t kBoxesOfATrack = 12;  ///< by which a track is found again
constexpr std::size_t kMostCompared = 48;

/// At most `count` of many, evenly, the first and the last among them.
template <class Value>
std::vector<Value> thinned(const std::vector<Value>& all, std::size_t count) {
    if (all.size() <= count) return all;
    std::vector<Value> some;
    for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * (all.size() - 1) / (count - 1)]);
    return some;
}

}  // namespace

std::vector<TrackFrame>::const_iterator firstFrom(const std::vector<TrackFrame>& states, FrameIndex frame) {
    return std::lower_bound(states.begin(), states.end(), frame,
                            [](const TrackFrame& each, FrameIndex at) { return each.frame < at; });
}

const TrackState* stateIn(const std::vector<TrackFrame>& states, FrameIndex frame) {
    const auto found = firstFrom(states, frame);
    return found != states.end() && found->frame == frame ? &found->state : nullptr;
}

std::vector<Sighting> sightingsOf(std::vector<TrackFrame>::const_iterator begin,
                                  std::vector<TrackFrame>::const_iterator end) {
    std::vector<Sighting> seen, all;
    for (auto each = begin; each != end; ++each) {
        all.push_back({each->frame, each->state.box});
        if (each->state.origin != StateOrigin::predicted) seen.push_back(all.back());
    }
    return thinned(seen.empty() ? all : seen, kBoxesOfATrack);
}

std::vector<Sighting> comparedOf(const std::vector<Sighting>& sightings) {
    return thinned(sightings, kMostCompared);
}

}  // namespace eyrie
