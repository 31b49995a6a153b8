#pragma once

#include "store/runs/run_store.h"

namespace eyrie {

/// The scale by which a track of a run is told as a whole: that at its mean place, under the mean zoom over its life.
/// As the view v_tracks has it.
inline SceneScale scaleOf(const TrackSummary& track, const SceneScale& scale) {
    return scale.zoomed(scale.zoom.meanOf(track.first_frame, track.last_frame)).at(track.place);
}

}  // namespace eyrie
