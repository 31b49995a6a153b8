#pragma once

#include "core/labels/box_record.h"
#include "core/values/track_state.h"

namespace eyrie {

/// A state as results tell it, without a class.
inline BoxRecord boxOf(FrameIndex frame, const TrackState& state) {
    BoxRecord record;
    record.frame = frame;
    record.id = state.id;
    record.box = state.box;
    record.score = state.score;
    record.velocity = state.velocity;
    record.origin = state.origin;
    return record;
}

}  // namespace eyrie
