#pragma once

#include <vector>

#include "tracking/finishing/track_finishing.h"
#include "tracking/ground_motion.h"
#include "tracking/shadows/silhouette_look.h"

namespace eyrie {

/// The silhouette of a track's vehicle in one picture.
struct SilhouetteLook {
    std::size_t path = 0;  ///< its place among the paths
    FrameIndex frame = 0;
    OrientedBox box;  ///< of its state
    Silhouette silhouette;
};

/// Looks at the vehicles of sure tracks, each at some moments of its life spread over it, beside pictures from before
/// and after in which no track covers the ground there. Reads each picture that it needs once, in ascending order.
std::vector<SilhouetteLook> lookAtSilhouettes(const std::vector<TrackPath>& paths, const GroundMotion& ground,
                                              const GrayOfFrame& gray_at, const SceneScale& scale);

}  // namespace eyrie
