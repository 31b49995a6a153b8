#pragma once

#include <vector>

#include "core/values/scene_scale.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/pictures/ground_turns.h"
#include "tracking/silhouettes/silhouette_search.h"

namespace eyrie {

/// Where the vehicles' shadows fall in a stretch of frames that are registered to each other.
struct CastShadow {
    FrameIndex stretch = 0;     ///< its first frame
    cv::Point2d reach_m{0, 0};  ///< m by which shadows reach beyond vehicles, in the axes of that frame's picture
    int tracks = 0;             ///< whose shadow is sure, and that say so
    double agreement = 0;       ///< share of what they say that points the same way, 0 … 1
};

/// Finds them from vehicles whose shadow is sure, since the vehicle itself is not in its own shade. One for each
/// stretch in which enough vehicles agree, in ascending order; nothing at night and under clouds.
std::vector<CastShadow> castShadows(const std::vector<SilhouetteLook>& looks, const GroundTurns& turns,
                                    const SceneScale& scale);

/// That of a stretch among them, null where it has none.
const CastShadow* shadowIn(const std::vector<CastShadow>& shadows, FrameIndex stretch);

/// px by which shadows reach beyond a vehicle that stands at `place` in a picture, in the picture's axes.
cv::Point2d reachAt(const CastShadow& shadow, const GroundTurns::Turn& turn, cv::Point2d place,
                    const SceneScale& scale);

/// Drops tracks that are nothing but the shadow of another: shaded, and driving beside it as if fixed to it where
/// shadows fall, no farther off than those of lorries reach.
void dropShadowTracks(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks,
                      const std::vector<CastShadow>& shadows, const GroundTurns& turns, const SceneScale& scale,
                      DropList& dropped);

/// Takes the shadow out of the boxes of tracks: as much of it as silhouettes show to be in each of them, which is
/// little where a box ends with the vehicle.
void takeOutShadows(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks,
                    const std::vector<CastShadow>& shadows, const GroundTurns& turns, const SceneScale& scale);

}  // namespace eyrie
