#pragma once

#include "core/labels/box_record.h"
#include "core/values/detection.h"
#include "core/values/track_state.h"

/// What the chain found, as lines of a result.
namespace eyrie {

/// A state of a track, without a class.
BoxRecord boxOf(FrameIndex frame, const TrackState& state);

/// A detection with the score that is shown of it, without id, class and origin.
BoxRecord boxOf(FrameIndex frame, const Detection& detection);

}  // namespace eyrie
