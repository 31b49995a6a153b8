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

template <class Visit>
void TrackOccupancy::visit(FrameIndex frame, Visit visit) const {
    const auto alive = alive_.find(spanOf(frame));
    if (alive == alive_.end()) return;
    for (const TrackPath* path : alive->second) {
        if (const TimedPathState* state = path->at(frame)) visit(OrientedBox(state->second.box));
    }
}

std::vector<OrientedBox> TrackOccupancy::in(FrameIndex frame) const {
    std::vector<OrientedBox> boxes;
    visit(frame, [&](const OrientedBox& box) { boxes.push_back(box); });
    return boxes;
}

bool TrackOccupancy::isFree(FrameIndex frame, const OrientedBox& box) const {
    bool free = true;
    visit(frame, [&](const OrientedBox& other) { free = free && overlap(other, box) <= kFree; });
    return free;
}

}  // namespace eyrie
