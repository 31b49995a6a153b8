#pragma once

#include "evaluation/comparison/significance.h"
#include "evaluation/measures/tracking_measures.h"

namespace eyrie {

/// Confidence of the two headline figures when whole tracks are drawn anew: true tracks bring their hits, misses and
/// switches, result tracks their false positives.
struct TrackBootstrap {
    BootstrapInterval f_score;
    BootstrapInterval mota;
};

/// Throws as bootstrap() does.
TrackBootstrap bootstrapTracks(const TrackTallies& tallies, const BootstrapOptions& options = {});

}  // namespace eyrie
