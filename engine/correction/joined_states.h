#pragma once

#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/review/track_correction.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// One track of two, as correctTracks() says; `one` begins first. Gaps of up to `longest_gap` frames between them are
/// filled with predicted states.
std::vector<TrackFrame> joinedStates(const std::vector<TrackFrame>& one, const std::vector<TrackFrame>& other,
                                     const CameraMotion& camera, int longest_gap);
/// Sightings of a person as states, with velocities over the ground where frames are connected.
std::vector<TrackFrame> statesByHand(const std::vector<Sighting>& sightings, const CameraMotion& camera);
/// Gives states an id, and ages and hits from their beginning on.
void renumber(std::vector<TrackFrame>& states, TrackId id);

}  // namespace eyrie
