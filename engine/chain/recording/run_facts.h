#pragma once

#include "store/runs/run_counts.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// The first step of the chain after which nothing was left, for a run without tracks.
enum class NothingFollowed {
    has_tracks,      ///< there are tracks
    no_frames,       ///< no frame was done
    too_few_frames,  ///< fewer were done than a track has to be detected in, RunFacts::frames_needed
    not_registered,  ///< no frame could be registered, so no motion could be measured
    no_motion,       ///< no corner moved otherwise than the ground
    no_detections,   ///< what moved was nowhere outlined as a vehicle
    all_rejected,    ///< every detection was rejected as duplicate, outlier or for its size
    none_confirmed,  ///< nothing was detected often enough for a confirmed track
    all_dropped      ///< what was followed was left out when the tracks were finished
};

/// What a person wants to know when a run has ended.
struct RunFacts {
    RunState state = RunState::finished;  ///< `running`: somebody writes it; a killed run counts as stopped
    int frames_planned = 0;
    RunCounts counts;
    double gsd_m_per_px = 0;
    ScaleBasis scale_basis;
    NothingFollowed nothing = NothingFollowed::has_tracks;
    int frames_needed = 0;  ///< fewer can have no track (tracking.confirm_hits); 0 where there are tracks
};

/// Why a run without tracks could not have any with the scale that was given for it, doubtOfGsd(); empty where its
/// scale is not the cause. It comes before what `nothing` says.
std::string doubtfulScaleOf(const RunFacts& facts);

/// Throws Error(project).
RunFacts factsOf(ProjectFile& project, const RunRecord& run);

}  // namespace eyrie
