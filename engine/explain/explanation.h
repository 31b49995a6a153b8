#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "chain/chain.h"
#include "core/evidence/light_finding.h"
#include "motion/clusters/clustering_trace.h"
#include "motion/vectors/corner_verdict.h"
#include "removal/removal_trace.h"
#include "tracking/tracking_trace.h"

namespace eyrie {

/// Whether what was compared lay on the right side of its limit; a note has no limit.
enum class StepVerdict { passed, failed, note };

/// One comparison on the way from pixels to a track.
struct ExplanationStep {
    std::string stage;  ///< "registration", "corners", "motion", "clustering", "detection" …
    StepVerdict verdict = StepVerdict::note;
    std::string text;       ///< for people, with the numbers: "4 motion vectors, 3 are needed"
    std::string parameter;  ///< that says the limit; may be empty
};

/// Why something was found at a place, or was not.
struct Explanation {
    bool found = false;                  ///< a reliable track lies there
    std::string sentence;                ///< the one thing that decided, with value and limit
    std::string parameter;               ///< that decided, e.g. "clustering.min_members"; empty where none did
    std::string setting;                 ///< its value in the run with its unit, e.g. "3 vectors"
    std::optional<Rejection> rejection;  ///< where removal decided
    std::optional<TrackDrop> drop;       ///< where finishing decided, or that the track is not confirmed
    std::vector<ExplanationStep> steps;  ///< in the order of the chain, up to the stage that decided
};

/// All that is known of one place of a frame.
struct PlaceEvidence {
    OrientedBox area;                         ///< the place, image px
    FrameResult result;                       ///< the frame as the run found it; tracks are the run's finished ones
    std::optional<CornerVerdicts> corners;    ///< on all corners of the frame; nothing: not looked at
    std::vector<SearchTrace> searches;        ///< of the search areas near the place
    ClusteringTrace clustering;               ///< of the whole frame; empty where clusters come from difference images
    RemovalTrace removal;                     ///< of the whole frame
    std::optional<TrackingTrace> tracking;    ///< nothing: not looked at
    std::vector<TrackState> unfinished;       ///< tracks before they were finished; for `tracking`
    std::map<TrackId, TrackEvidence> judged;  ///< what speaks for the finished tracks here, and those left out
    std::optional<FrameShadow> shadow;        ///< where shadows fall to in the frame; nothing: not known
    std::map<TrackId, BoxTrim> trims;         ///< what was taken out of the boxes of the finished tracks
};

/// Goes through the stages of the chain at one place and names the parameter that decided. `options` and `scale` are
/// those of the run.
Explanation explain(const PlaceEvidence& evidence, const ChainOptions& options, const SceneScale& scale);

/// The place that is meant by a point: a square as long as a car, at least 8 px.
OrientedBox placeAt(cv::Point2d point, const SceneScale& scale);

}  // namespace eyrie
