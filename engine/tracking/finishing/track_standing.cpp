#include "tracking/finishing/flow_comparison.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

constexpr double kLeastFlow = 0.2;  ///< px/frame; below that the camera does not move enough to tell
constexpr double kAlongFlow = 0.8;  ///< cosine of the angle to the flow

/// A thing that rises to `height` of the flight height moves this much of the ground's own motion more than the ground.
double parallaxAt(double height) {
    return height / (1 - height);
}

/// Whether a track cannot be told from something that stands, by its motion alone.
bool movesLikeStanding(const TrackPath& path, const GroundMotion& ground, const FinishingOptions& options) {
    const auto motion = comparedWithFlow(path, ground);
    if (!motion || motion->flow < kLeastFlow) return false;
    const bool above = motion->alignment > kAlongFlow && motion->ratio < parallaxAt(options.standing_height);
    const bool below = motion->alignment < -kAlongFlow && motion->ratio < parallaxAt(options.standing_depth);
    const bool never_moved = motion->fastest < parallaxAt(options.standing_depth);
    return above || below || never_moved;
}

}  // namespace

void dropStanding(std::vector<TrackPath>& paths, const GroundMotion& ground, const VehicleLooks& looks,
                  const FinishingOptions& options, DropList& dropped) {
    std::erase_if(paths, [&](TrackPath& path) {
        if (looks.contains(path.id) || !movesLikeStanding(path, ground, options)) return false;
        drop(path, TrackDrop::could_stand, dropped);
        return true;
    });
}

}  // namespace eyrie
