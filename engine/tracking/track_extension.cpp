#include <algorithm>
#include <unordered_map>

#include "tracking/track_paths.h"

namespace eyrie {
namespace {

constexpr double kFree = 0.15;    ///< largest overlap of an extension with another track
constexpr double kInImage = 0.5;  ///< share of the box an extension must have in the image

bool inImage(const OrientedBox& box, cv::Size image) {
    return image.area() > 0 && areaInImage(box, image) >= kInImage * box.area();
}

/// The frames to extend by: back to the border where the track came in, when that is not longer ago than
/// `entry_frames`, otherwise `frames`.
int extensionOf(const TrackPath& path, const GroundMotion& ground, int frames, int entry_frames) {
    MovingState earlier{path.states.front().second.box, path.states.front().second.velocity};
    for (int back = 1; back <= entry_frames; ++back) {
        const FrameIndex frame = path.firstFrame() - back;
        const auto carried = ground.carried(earlier, frame + 1, frame, false);
        if (!carried) break;
        if (!inImage(carried->box, ground.imageSize(frame))) return std::max(frames, back);
        earlier = *carried;
    }
    return frames;
}

}  // namespace

void extendBack(std::vector<TrackPath>& paths, const GroundMotion& ground, int frames, int entry_frames) {
    if (frames < 1 && entry_frames < 1) return;
    std::unordered_map<FrameIndex, std::vector<OrientedBox>> boxes;
    for (const TrackPath& path : paths) {
        for (const auto& [frame, state] : path.states) boxes[frame].push_back(state.box);
    }
    for (TrackPath& path : paths) {
        // A predicted beginning was extended before.
        if (path.states.front().second.origin == StateOrigin::predicted) continue;
        const int wanted = extensionOf(path, ground, frames, entry_frames);
        std::vector<TimedState> extension;
        TrackState earlier = path.states.front().second;
        for (FrameIndex frame = path.firstFrame(); static_cast<int>(extension.size()) < wanted; --frame) {
            const auto carried = ground.carried({earlier.box, earlier.velocity}, frame, frame - 1, false);
            if (!carried || !inImage(carried->box, ground.imageSize(frame - 1))) break;
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
