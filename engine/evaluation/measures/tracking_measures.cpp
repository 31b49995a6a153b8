#include "evaluation/measures/tracking_measures.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

/// Track number of the box with this index in the frame's records; `indices` ascend.
int trackOf(const std::vector<int>& indices, const std::vector<int>& tracks, int index) {
    return tracks[static_cast<std::size_t>(std::lower_bound(indices.begin(), indices.end(), index) - indices.begin())];
}

/// What is remembered of a true track from frame to frame.
struct Memory {
    int last_result = -1;
    bool tracked = false;
};

}  // namespace

TrackTallies tallyTracks(const EvaluationInput& input, const std::vector<FrameMatch>& matches,
                         const EvaluationOptions& options) {
    const bool thesis = options.convention == Convention::thesis;
    TrackTallies tallies;
    for (const int id : input.truth_ids) tallies.truth.push_back({.id = id});
    for (const int id : input.result_ids) tallies.results.push_back({.id = id});
    std::vector<Memory> memory(input.truth_ids.size());

    for (std::size_t f = 0; f < matches.size(); ++f) {
        const EvaluationFrame& frame = input.frames[f];
        const FrameMatch& match = matches[f];
        std::vector<char> tracked_now(memory.size(), 0);
        for (const MatchedPair& pair : match.pairs) {
            const auto truth = static_cast<std::size_t>(trackOf(frame.truth, frame.truth_tracks, pair.truth));
            const int result = trackOf(frame.results, frame.result_tracks, pair.result);
            TruthTrackTally& tally = tallies.truth[truth];
            ++tally.frames;
            ++tally.matched;
            tally.overlap_sum += pair.overlap;
            Memory& last = memory[truth];
            if (last.last_result >= 0 && last.last_result != result) ++tally.switches;
            last.last_result = result;
            if (!last.tracked) ++tally.tracked_runs;
            last.tracked = true;
            tracked_now[truth] = 1;
            ++tallies.results[static_cast<std::size_t>(result)].matched;
        }
        for (const int index : match.missed) {
            const auto truth = static_cast<std::size_t>(trackOf(frame.truth, frame.truth_tracks, index));
            TruthTrackTally& tally = tallies.truth[truth];
            ++tally.frames;
            if (tally.matched == 0) ++tally.until_found;
            if (thesis && memory[truth].tracked) {
                ++tally.fragments;
                memory[truth].tracked = false;
            }
        }
        for (const int index : match.false_results) {
            const int result = trackOf(frame.results, frame.result_tracks, index);
            ++tallies.results[static_cast<std::size_t>(result)].false_positives;
        }
        // Absence ends a run for TrackEval, whose runs go on over frames without any object or any result.
        const bool passed_over = frame.truth.empty() || frame.results.empty();
        if (thesis || passed_over) continue;
        for (std::size_t t = 0; t < memory.size(); ++t) memory[t].tracked = tracked_now[t] != 0;
    }
    return tallies;
}

TrackedLife trackedLife(const TruthTrackTally& object, Convention convention) {
    const double share = static_cast<double>(object.matched) / std::max(object.frames, 1);
    // TrackEval counts 80 % itself as partially tracked.
    if (convention == Convention::thesis ? share >= kMostlyTracked : share > kMostlyTracked) return TrackedLife::mostly;
    return share < kMostlyLost ? TrackedLife::mostly_lost : TrackedLife::partially;
}

int fragmentsOf(const TruthTrackTally& object, Convention convention) {
    return convention == Convention::thesis ? object.fragments : std::max(object.tracked_runs - 1, 0);
}

TrackingMeasures trackingMeasures(const TrackTallies& tallies, const DetectionMeasures& detection,
                                  const EvaluationOptions& options) {
    TrackingMeasures m;
    m.truth_tracks = static_cast<int>(tallies.truth.size());
    m.result_tracks = static_cast<int>(tallies.results.size());
    double until_found = 0;
    for (const TruthTrackTally& tally : tallies.truth) {
        until_found += tally.until_found;
        m.id_switches += tally.switches;
        m.fragments += fragmentsOf(tally, options.convention);
        switch (trackedLife(tally, options.convention)) {
            case TrackedLife::mostly:
                ++m.mostly_tracked;
                break;
            case TrackedLife::partially:
                ++m.partially_tracked;
                break;
            case TrackedLife::mostly_lost:
                ++m.mostly_lost;
                break;
        }
    }
    m.initialisation_frames = until_found / std::max(m.truth_tracks, 1);
    const double objects = std::max(detection.ground_truth, 1);
    const double errors = detection.false_negatives + detection.false_positives;
    const double log_switches = m.id_switches > 0 ? std::log10(m.id_switches) : 0;
    m.mota = 1 - (errors + m.id_switches) / objects;
    m.motp = detection.n_modp;
    m.mota_log = 1 - (errors + log_switches) / objects;
    m.mota_soft = (detection.overlap_sum - detection.false_positives - m.id_switches) / objects;
    return m;
}

}  // namespace eyrie
