#pragma once

#include <array>

#include "core/evidence/track_evidence.h"
#include "tracking/finishing/flow_comparison.h"
#include "tracking/finishing/vehicle_looks.h"
#include "tracking/ground_motion.h"

namespace eyrie {

/// How often a track was seen, in frames.
struct TrackTally {
    int states = 0;  ///< without those in which it stands
    int detected = 0;
    TrackLooks looks = {};
};

/// The evidence with its score. `motion`: nothing where it is not known.
TrackEvidence evidenceOf(const TrackTally& tally, const std::optional<FlowComparison>& motion, double frame_rate_hz);

/// Of a whole track, whose motion is compared with that of the ground under it.
TrackEvidence evidenceOf(const TrackPath& path, const TrackLooks& looks, const GroundMotion& ground,
                         const SceneScale& scale);

/// Probability that a track of this evidence is a vehicle that moves. A logistic regression over eight figures of the
/// evidence, learned by tests/learn_track_score from real clips and rendered scenes; see docs/figures.md.
double probabilityOf(const TrackEvidence& evidence);

/// By how much each kind of evidence speaks for a vehicle that moves (above 0) or against it, in log-odds: the score is
/// 1 / (1 + exp(−sum)).
struct ScoreParts {
    double looks = 0;  ///< how much it looked like a vehicle, and what is thought of a track of which nothing is known
    double detected = 0;  ///< how often it was detected, beside a usual share
    double life = 0;      ///< how long it lived, beside .9 s
    double motion = 0;    ///< its own motion beside the camera's
    double sum() const { return looks + detected + life + motion; }
};
ScoreParts partsOf(const TrackEvidence& evidence);

}  // namespace eyrie
