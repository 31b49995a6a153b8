#pragma once

#include <map>
#include <optional>
#include <stop_token>

#include "explain/explanation.h"
#include "rerun/motion_window.h"
#include "rerun/replay.h"

namespace eyrie {

/// Gathers what is known of a place in a stored run and explains it: replays the frame, registers the frames before it
/// once more to judge its corners, and follows the tracks through the stored detections before it. What was done for a
/// frame serves its other places. For one thread.
class PlaceExplainer {
 public:
    /// `source.result_of` is needed. Throws Error where the parameters ask for a model file that cannot be read.
    explicit PlaceExplainer(ReplaySource source);

    /// Nothing when `stop` was requested meanwhile. Throws Error(input | project) when the run has no such frame, or
    /// pixels or results cannot be read.
    std::optional<Explanation> explain(FrameIndex frame, const OrientedBox& area, const std::stop_token& stop);

    /// What the last explanation rests on.
    const PlaceEvidence& evidence() const { return evidence_; }
    const ChainOptions& options() const { return source_.options; }
    const SceneScale& scale() const { return source_.scale; }

 private:
    bool gather(FrameIndex frame, const std::stop_token& stop);
    bool followTracks(FrameIndex frame, const std::stop_token& stop);

    ReplaySource source_;
    Replay replay_;
    MotionWindow window_;
    PlaceEvidence evidence_;
    std::optional<FrameIndex> gathered_;
};

}  // namespace eyrie
