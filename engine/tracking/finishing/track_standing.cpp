#include <algorithm>

#include "tracking/finishing/flow_comparison.h"
#include "tracking/finishing/implied_height.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

constexpr double kLeastFlow = 0.2;  ///< px/frame; below that the camera does not move enough to tell
constexpr double kOblique = 0.8;    ///< cosine from straight down: only oblique views tell the camera's way surely
constexpr double kLeastHeight = 0.03;
constexpr double kLeastMoved = 4;   ///< px in a window
constexpr double kMostRest = 0.15;  ///< of that: what a standing thing does not explain

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

/// Whether a track moves just as a thing no higher than `highest` would that stands where the camera passes. That is so
/// exact an account that up to some height it also outweighs what looks like a vehicle.
bool movesAsPassed(const TrackPath& path, const GroundMotion& ground, double highest) {
    if (highest <= 0) return false;
    const auto implied = impliedHeightOf(path, ground);
    return implied && implied->oblique < kOblique && implied->moved > kLeastMoved &&
           implied->rest < kMostRest * implied->moved && implied->height > kLeastHeight && implied->height < highest;
}

/// Whether it is mostly seen above the horizon: what rises higher than the camera is no vehicle on the ground.
bool risesAboveHorizon(const TrackPath& path, const GroundMotion& ground) {
    const auto above = std::count_if(path.states.begin(), path.states.end(), [&](const TimedPathState& state) {
        return ground.aboveHorizon(state.second.box);
    });
    return 2 * above > static_cast<std::ptrdiff_t>(path.states.size());
}

}  // namespace

void dropStanding(std::vector<TrackPath>& paths, const GroundMotion& ground, const VehicleLooks& looks,
                  const FinishingOptions& options, DropList& dropped) {
    std::erase_if(paths, [&](TrackPath& path) {
        const auto seen = looks.find(path.id);
        const bool unlike = seen == looks.end() || seen->second.alike == 0;
        const double highest =
            unlike ? std::max(options.standing_height, options.roof_height) : options.standing_height;
        const bool stands = unlike && movesLikeStanding(path, ground, options);
        const bool rises = options.standing_height > 0 && risesAboveHorizon(path, ground);
        if (!stands && !rises && !movesAsPassed(path, ground, highest)) return false;
        drop(path, TrackDrop::could_stand, dropped);
        return true;
    });
}

}  // namespace eyrie
