#pragma once

#include <vector>

#include "core/review/track_correction.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// The corrections that make it so, without number and person. Tracks as they are shown when it is made.
TrackCorrection additionOf(std::vector<Sighting> boxes, FrameIndex drawn);
TrackCorrection joinOf(const std::vector<TrackFrame>& one, const std::vector<TrackFrame>& other);
/// `frame` is the first of the later part. Throws Error(parameter) where it leaves nothing of the track.
TrackCorrection splitOf(const std::vector<TrackFrame>& track, FrameIndex frame);
/// `beside`: the track on the same vehicle that is kept; none: there is no such.
TrackCorrection rejectionOf(const std::vector<TrackFrame>& track, const std::vector<TrackFrame>& beside = {});

}  // namespace eyrie
