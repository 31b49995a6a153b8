#include <algorithm>

#include "tracking/finishing/track_occupancy.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

constexpr double kExtensionInImage = 0.5;  ///< share of the box an extension must have in the image

bool inImage(const OrientedBox& box, cv::Size image) {
    return image.area() > 0 && areaInImage(box, image) >= kExtensionInImage * box.area();
}

/// The frames to extend by: back to the border where the track came in, when that is not longer ago than
/// `entry_frames`, otherwise `frames`.
int extensionOf(const TrackPath& path, const GroundMotion& ground, int frames, int entry_frames) {
    MovingState earlier = movingOf(path.states.front().second);
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
    TrackOccupancy taken(paths);
    for (TrackPath& path : paths) {
        // A predicted beginning was extended before.
        if (path.states.front().second.origin == StateOrigin::predicted) continue;
        const int wanted = extensionOf(path, ground, frames, entry_frames);
        std::vector<TimedPathState> extension;
        PathState earlier = path.states.front().second;
        for (FrameIndex frame = path.firstFrame(); static_cast<int>(extension.size()) < wanted; --frame) {
            const auto carried = ground.carried(movingOf(earlier), frame, frame - 1, false);
            if (!carried || !inImage(carried->box, ground.imageSize(frame - 1))) break;
            if (!taken.isFree(frame - 1, carried->box)) break;
            earlier.box = carried->box;
            earlier.velocity = carried->velocity;
            earlier.origin = StateOrigin::predicted;
            earlier.hits = 0;
            extension.emplace_back(frame - 1, earlier);
        }
        prepend(path, extension);
        taken.extended(path);
    }
}

}  // namespace eyrie
