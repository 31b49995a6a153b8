#pragma once

#include <vector>

#include "evaluation/matching.h"
#include "evaluation/measures/detection_measures.h"

namespace eyrie {

/// What happened to one true track.
struct TruthTrackTally {
    int id = 0;
    int frames = 0;        ///< in which the object counts
    int matched = 0;       ///< of those, with a result
    int switches = 0;      ///< times its result's id differs from the last one it had
    int fragments = 0;     ///< changes from tracked to not tracked (thesis)
    int until_found = 0;   ///< frames in which it counts before its first result; all if it has none
    int tracked_runs = 0;  ///< uninterrupted stretches of being tracked (trackeval)
    double overlap_sum = 0;
};

/// How much of an object's life was found: MT, PT, MLT.
enum class TrackedLife { mostly, partially, mostly_lost };
inline constexpr double kMostlyTracked = 0.8;  ///< share of its frames from which on it is
inline constexpr double kMostlyLost = 0.2;     ///< below
TrackedLife trackedLife(const TruthTrackTally& object, Convention convention);
/// The fragments of its track, as the convention counts them.
int fragmentsOf(const TruthTrackTally& object, Convention convention);

/// Matches and errors of one result track.
struct ResultTrackTally {
    int id = 0;
    int matched = 0;
    int false_positives = 0;
};

/// Per track, for lists of errors and for resampling; ascending ids.
struct TrackTallies {
    std::vector<TruthTrackTally> truth;
    std::vector<ResultTrackTally> results;
};

/// Tracking quality over a sequence (Teutsch §7.1.2).
struct TrackingMeasures {
    double mota = 0;  ///< eq. 7.9 with c_s(x) = x
    double motp = 0;  ///< mean overlap of the matched pairs; eq. 7.10 prints "1 −"
    int id_switches = 0;
    int mostly_tracked = 0;  ///< see trackedLife()
    int partially_tracked = 0;
    int mostly_lost = 0;
    int fragments = 0;  ///< FM; see fragmentsOf()
    /// TID, track initialisation duration (Caesar et al., CVPR 2020), in frames: how long an object counts on average
    /// before it is found for the first time; one that is never found counts with all its frames.
    double initialisation_frames = 0;
    int truth_tracks = 0;
    int result_tracks = 0;
    double mota_log = 0;   ///< MOTA with log10(switches)
    double mota_soft = 0;  ///< TrackEval's sMOTA: overlaps instead of counts of true positives
};

/// `input.has_tracks` must hold.
TrackTallies tallyTracks(const EvaluationInput& input, const std::vector<FrameMatch>& matches,
                         const EvaluationOptions& options);
TrackingMeasures trackingMeasures(const TrackTallies& tallies, const DetectionMeasures& detection,
                                  const EvaluationOptions& options);

}  // namespace eyrie
