#include "core/labels/result_box.h"

namespace eyrie {

BoxRecord boxOf(FrameIndex frame, const TrackState& state) {
    BoxRecord record;
    record.frame = frame;
    record.id = state.id;
    record.box = state.box;
    record.score = state.score;
    record.velocity = state.velocity;
    record.origin = state.origin;
    return record;
}

BoxRecord boxOf(FrameIndex frame, const Detection& detection) {
    BoxRecord record;
    record.frame = frame;
    record.box = detection.box;
    record.score = shownScore(detection);
    record.velocity = detection.velocity;
    return record;
}

}  // namespace eyrie
