#pragma once

#include <vector>

#include "core/review/track_correction.h"
#include "store/runs/run_store.h"

/// The states of one track, ascending frames.
namespace eyrie {

/// The first state in a frame or after it.
std::vector<TrackFrame>::const_iterator firstFrom(const std::vector<TrackFrame>& states, FrameIndex frame);
/// Null: the track has none there.
const TrackState* stateIn(const std::vector<TrackFrame>& states, FrameIndex frame);
/// Some boxes by which states are found again, rather those that were seen.
std::vector<Sighting> sightingsOf(std::vector<TrackFrame>::const_iterator begin,
                                  std::vector<TrackFrame>::const_iterator end);
/// Those of many boxes by which tracks are compared with what a correction holds: a few dozen, evenly.
std::vector<Sighting> comparedOf(const std::vector<Sighting>& sightings);

}  // namespace eyrie
