#pragma once

#include <vector>

#include "core/evidence/light_finding.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/pictures/cast_shadow.h"
#include "tracking/pictures/ground_turns.h"
#include "tracking/pictures/headlight_beams.h"

namespace eyrie {

/// A search that was never made, as the finding of all frames of the tracks; nothing without tracks.
RunLight untoldLight(const std::vector<TrackPath>& paths, LightOutcome why);

/// What was read off the vehicles in each stretch of frames. Neighbouring ones in which nothing was found, for the same
/// reason, are told as one. `trims`: what was taken out of the boxes of `paths`; `shadows`: tracks that were left out
/// as such.
RunLight toldShadows(const std::vector<StretchLight>& read, const GroundTurns& turns, const SceneScale& scale,
                     const std::vector<TrackPath>& paths, std::map<TrackId, BoxTrim> trims,
                     const std::vector<TrackPath>& shadows);

/// That headlights were found to light the ground, in all frames.
RunLight toldBeams(BeamFinding beams, const GroundTurns& turns);

}  // namespace eyrie
