#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/labels/box_record.h"
#include "evaluation/comparison/significance.h"
#include "evaluation/matching.h"
#include "evaluation/measures/tracking_measures.h"

namespace eyrie {

/// Hits and errors of one result that fall to one true track, or to one stretch of time (false positives belong to no
/// true track, so they are drawn by the second they happened in).
struct UnitTally {
    double matched = 0;
    double missed = 0;
    double switches = 0;
    double false_positives = 0;
};

/// A result by units that every result on the same ground truth has in common: the true tracks in ascending order of
/// their ids, then stretches of time. Units of two results can thus be drawn together.
struct PairedTallies {
    std::vector<UnitTally> units;
    bool has_switches = false;  ///< the result's boxes have ids, so that MOTA is defined
};

/// `truth` is what `matches` was made from; `tracks` its tallies, or null where the result has no ids; `frames` the
/// range that was compared, inclusive; `block_frames`: length of a stretch of time, at least 1.
PairedTallies pairedTallies(const BoxesByFrame& truth, const std::vector<FrameMatch>& matches,
                            const TrackTallies* tracks, std::pair<FrameIndex, FrameIndex> frames, int block_frames);

/// How much better a result is than another on the same ground truth, and how sure that is.
struct MethodDifference {
    BootstrapInterval f_score;              ///< of a − of b
    std::optional<BootstrapInterval> mota;  ///< where both have it
};

/// Throws Error(input) unless both were made from the same ground truth and range.
MethodDifference methodDifference(const PairedTallies& a, const PairedTallies& b, const BootstrapOptions& options = {});

/// Interval of one result's own f-score.
BootstrapInterval fScoreInterval(const PairedTallies& tallies, const BootstrapOptions& options = {});

}  // namespace eyrie
