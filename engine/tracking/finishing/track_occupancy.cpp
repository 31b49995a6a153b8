#include "tracking/finishing/track_occupancy.h"

#include <algorithm>
#include <optional>

namespace eyrie {
namespace {

constexpr double kFree = 0.15;   ///< largest overlap with another track
constexpr int kSpanFrames = 32;  ///< tracks are noted by spans of so many frames

int spanOf(FrameIndex frame) {
    return frame / kSpanFrames;
}

}  // namespace

TrackOccupancy::TrackOccupancy(const std::vector<TrackPath>& paths) {
    for (const TrackPath& path : paths) extended(path);
}

void TrackOccupancy::extended(const TrackPath& path) {
    std::optional<int> noted;
    for (const auto& [frame, state] : path.states) {
        if (noted == spanOf(frame)) continue;
        noted = spanOf(frame);
        reaches(path, frame);
    }
}

void TrackOccupancy::reaches(const TrackPath& path, FrameIndex frame) {
    auto& alive = alive_[spanOf(frame)];
    if (std::find(alive.begin(), alive.end(), &path) == alive.end()) alive.push_back(&path);
}

template <class Holds>
bool TrackOccupancy::all(FrameIndex frame, Holds holds) const {
    const auto alive = alive_.find(spanOf(frame));
    if (alive == alive_.end()) return true;
    return std::all_of(alive->second.begin(), alive->second.end(), [&](const TrackPath* path) {
        const TimedPathState* state = path->at(frame);
        return state == nullptr || holds(OrientedBox(state->second.box));
    });
}

std::vector<OrientedBox> TrackOccupancy::in(FrameIndex frame) const {
    std::vector<OrientedBox> boxes;
    all(frame, [&](const OrientedBox& box) {
        boxes.push_back(box);
        return true;
    });
    return boxes;
}

bool TrackOccupancy::isFree(FrameIndex frame, const OrientedBox& box) const {
    return all(frame, [&](const OrientedBox& other) { return overlap(other, box) <= kFree; });
}

bool TrackOccupancy::isBare(FrameIndex frame, const OrientedBox& box) const {
    return all(frame, [&](const OrientedBox& other) { return !(intersectionArea(box, other) > 0); });
}

}  // namespace eyrie
