#pragma once

#include <vector>

#include "correction/corrected_tracks.h"

/// Tracks worked out by hand, for tests of corrections.
namespace eyrie::test {

/// A vehicle of 10 × 5 px that drives `step` px a frame to the right, at x = `x` in frame 0.
inline OrientedBox drivenBox(FrameIndex frame, double x, double y, double step) {
    return {{x + step * frame, y}, 10, 5, 0};
}

inline std::vector<TrackFrame> drivenStates(TrackId id, FrameIndex first, FrameIndex last, double x, double y = 50,
                                            double step = 2) {
    std::vector<TrackFrame> states;
    for (FrameIndex frame = first; frame <= last; ++frame) {
        TrackState state;
        state.id = id;
        state.box = drivenBox(frame, x, y, step);
        state.velocity = {step, 0};
        state.status = TrackStatus::confirmed;
        state.score = 0.5 + 0.01 * id;
        states.push_back({frame, state});
    }
    return states;
}

inline std::vector<Sighting> drivenSightings(FrameIndex first, FrameIndex last, double x, double y = 50,
                                             double step = 2) {
    std::vector<Sighting> seen;
    for (FrameIndex frame = first; frame <= last; ++frame) seen.push_back({frame, drivenBox(frame, x, y, step)});
    return seen;
}

/// A run of frames 0 … 99 of a standing camera, at 10 Hz.
inline TracksToCorrect runOf(std::map<TrackId, std::vector<TrackFrame>> tracks) {
    TracksToCorrect run;
    run.tracks = std::move(tracks);
    run.last_frame = 99;
    run.frame_rate_hz = 10;
    run.last_id = 20;
    return run;
}

inline std::map<int, TrackCorrection> numbered(std::vector<TrackCorrection> made) {
    std::map<int, TrackCorrection> corrections;
    int id = 0;
    for (TrackCorrection& correction : made) {
        correction.id = ++id;
        corrections[id] = std::move(correction);
    }
    return corrections;
}

}  // namespace eyrie::test
