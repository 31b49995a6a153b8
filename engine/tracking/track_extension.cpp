#include <algorithm>
#include <unordered_map>

#include "tracking/track_paths.h"

namespace eyrie {
namespace {

constexpr double kFree = 0.15;  ///< largest overlap of an extension with another track

}  // namespace

void extendBack(std::vector<TrackPath>& paths, const GroundMotion& ground, int frames) {
    if (frames < 1) return;
    std::unordered_map<FrameIndex, std::vector<OrientedBox>> boxes;
    for (const TrackPath& path : paths) {
        for (const auto& [frame, state] : path.states) boxes[frame].push_back(state.box);
    }
    for (TrackPath& path : paths) {
        // A predicted beginning was extended before.
        if (path.states.front().second.origin == StateOrigin::predicted) continue;
        std::vector<TimedState> extension;
        TrackState earlier = path.states.front().second;
        for (FrameIndex frame = path.firstFrame(); static_cast<int>(extension.size()) < frames; --frame) {
            const auto carried = ground.carried({earlier.box, earlier.velocity}, frame, frame - 1, false);
            if (!carried || ground.cutByBorder(carried->box, frame - 1)) break;
            std::vector<OrientedBox>& others = boxes[frame - 1];
            const bool free = std::all_of(others.begin(), others.end(), [&](const OrientedBox& other) {
                return overlap(other, carried->box) <= kFree;
            });
            if (!free) break;
            earlier.box = carried->box;
            earlier.velocity = carried->velocity;
            earlier.origin = StateOrigin::predicted;
            earlier.hits = 0;
            others.push_back(earlier.box);
            extension.emplace_back(frame - 1, earlier);
        }
        path.states.insert(path.states.begin(), extension.rbegin(), extension.rend());
    }
}

}  // namespace eyrie
