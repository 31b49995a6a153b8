#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/values/scene_scale.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/ground_motion.h"
#include "tracking/pictures/cast_shadow.h"
#include "tracking/pictures/ground_turns.h"
#include "tracking/silhouettes/silhouette_search.h"

namespace eyrie {

/// By each track whose box was made as long as its vehicle: those that drive as if fixed to it.
using PartsByVehicle = std::map<TrackId, std::set<TrackId>>;

/// Makes boxes that hold a part of a lorry or a bus as long as it is, as far as most looks at it agree how far it hides
/// the ground: not beyond other vehicles, and, as long as nothing tells where shadows fall, only where it surely is no
/// shadow. Not where a vehicle would not be longer than a car. Tells whose boxes it made longer.
PartsByVehicle reachWholeVehicles(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks,
                                  const std::vector<CastShadow>& shadows, const GroundTurns& turns,
                                  const SceneScale& scale);

/// Frames from a first to a last one.
using FrameSpan = std::pair<FrameIndex, FrameIndex>;

/// Of a track that was joined from fragments, of which those in some spans, in ascending order, are as long as the
/// vehicle: makes the others as long by how they lie to it where they meet.
void reachAlong(TrackPath& path, const std::vector<FrameSpan>& whole, const GroundMotion& ground);

/// Drops tracks that, while they share frames with one of those, which is half of their life or more, lie in its box,
/// or reach out over it, driving as if fixed to it.
void dropPartsOf(const PartsByVehicle& whole, std::vector<TrackPath>& paths, const SceneScale& scale,
                 DropList& dropped);

}  // namespace eyrie
