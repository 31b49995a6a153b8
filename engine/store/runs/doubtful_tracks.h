#pragma once

#include <optional>
#include <vector>

#include "store/runs/run_store.h"

namespace eyrie {

/// Reads the tracks that only their score kept out of a run's result (`finishing.min_score`), and what speaks for and
/// against each track. Throws Error(project) for contents that no writer wrote.
class DoubtfulTracks {
 public:
    /// `project` must outlive it.
    explicit DoubtfulTracks(ProjectFile& project) : project_(project) {}

    std::vector<TrackSummary> summaries(int run_id) const;                 ///< ascending id
    std::vector<TrackState> statesIn(int run_id, FrameIndex frame) const;  ///< ascending id
    std::vector<TrackFrame> statesOf(int run_id, TrackId track) const;     ///< ascending frames
    std::vector<TrackFrame> statesUpTo(int run_id, FrameIndex frame,
                                       int trail) const;  ///< states of frames (frame − trail, frame], for trails
    BoxesByFrame boxes(int run_id) const;
    /// What speaks for a track, of the result or left out; nothing where no classifier took part.
    std::optional<TrackEvidence> evidence(int run_id, TrackId track) const;
    /// The score below which tracks of the run are doubtful; 0 where tracks have no score.
    double scoreThreshold(int run_id) const;

 private:
    ProjectFile& project_;
};

}  // namespace eyrie
