#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "review/tracks/track_filter.h"

namespace eyrie::ui {

/// The chips of the list of tracks as a question about anything that happens to tracks, such as events. Never changed
/// once it is made.
class TrackQuery {
 public:
    /// What it asks by; both may be null.
    struct Known {
        std::shared_ptr<const DoingsByTrack> doings;
        std::shared_ptr<const LikenessByTrack> likeness;
    };

    /// `tracks`: all that the list has.
    TrackQuery(const TrackFilter& filter, const std::vector<TrackSummary>& tracks, const SceneScale& scale, Known known,
               const FrameOfDay& frame_of_day);

    /// Whether what happens to these tracks in `frames` passes: a time by these frames, all else where one of the
    /// tracks passes, and "now" is `frame`. Tracks that the list does not have hide nothing, nor does it where there
    /// are none.
    bool passes(const std::vector<TrackId>& tracks, FrameSpan frames, FrameIndex frame) const;

 private:
    TrackFilter filter_;  ///< but for the time
    FrameSpan frames_;    ///< that the time leaves
    std::unordered_map<TrackId, TrackSummary> tracks_;
    SceneScale scale_;
    Known known_;
};

}  // namespace eyrie::ui
