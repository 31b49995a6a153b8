#include "tracking/taken_places.h"

#include <algorithm>

namespace eyrie {
namespace {

constexpr double kFree = 0.15;  ///< largest overlap with another track

}  // namespace

TakenPlaces::TakenPlaces(const std::vector<TrackPath>& paths) {
    for (const TrackPath& path : paths) {
        for (const auto& [frame, state] : path.states) take(frame, state.box);
    }
}

const std::vector<OrientedBox>& TakenPlaces::in(FrameIndex frame) const {
    static const std::vector<OrientedBox> kNone;
    const auto boxes = boxes_.find(frame);
    return boxes == boxes_.end() ? kNone : boxes->second;
}

bool TakenPlaces::isFree(FrameIndex frame, const OrientedBox& box) const {
    const std::vector<OrientedBox>& others = in(frame);
    return std::none_of(others.begin(), others.end(),
                        [&](const OrientedBox& other) { return overlap(other, box) > kFree; });
}

}  // namespace eyrie
