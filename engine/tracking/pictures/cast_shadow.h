#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/evidence/light_finding.h"
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

/// What vehicles say of the shadows of a stretch, used or not.
struct StretchLight {
    CastShadow shadow;
    double scatter_m = 0;  ///< median of how far what they say is from it
    /// Median share of its brightness that the ground loses in them; nothing where no vehicle shows it.
    std::optional<double> darkening = std::nullopt;
    LightOutcome outcome = LightOutcome::shadows;  ///< anything else: it is not used
};

/// Asks vehicles whose shadow is sure, since the vehicle itself is not in its own shade. One for each stretch in which
/// a track was looked at, in ascending order.
std::vector<StretchLight> readLight(const std::vector<SilhouetteLook>& looks, const GroundTurns& turns,
                                    const SceneScale& scale);

/// Those that are used, of stretches in which enough vehicles agree; nothing at night and under clouds.
std::vector<CastShadow> shadowsOf(const std::vector<StretchLight>& read);

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
/// little where a box ends with the vehicle. What was taken out of which.
std::map<TrackId, BoxTrim> takeOutShadows(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks,
                                          const std::vector<CastShadow>& shadows, const GroundTurns& turns,
                                          const SceneScale& scale);

}  // namespace eyrie
