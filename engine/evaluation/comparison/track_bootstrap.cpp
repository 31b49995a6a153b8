#include "evaluation/comparison/track_bootstrap.h"

#include <algorithm>

namespace eyrie {
namespace {

struct Sums {
    double matched = 0;
    double missed = 0;
    double switches = 0;
    double false_positives = 0;
};

/// The first units are the true tracks, the others the result tracks.
Sums drawnSums(const TrackTallies& tallies, const std::vector<int>& counts) {
    Sums sums;
    std::size_t unit = 0;
    for (const TruthTrackTally& track : tallies.truth) {
        const double times = counts[unit++];
        sums.matched += times * track.matched;
        sums.missed += times * (track.frames - track.matched);
        sums.switches += times * track.switches;
    }
    for (const ResultTrackTally& track : tallies.results)
        sums.false_positives += counts[unit++] * track.false_positives;
    return sums;
}

}  // namespace

TrackBootstrap bootstrapTracks(const TrackTallies& tallies, const BootstrapOptions& options) {
    const int units = static_cast<int>(tallies.truth.size() + tallies.results.size());
    TrackBootstrap result;
    result.f_score = bootstrap(
        units,
        [&](const std::vector<int>& counts) {
            const Sums s = drawnSums(tallies, counts);
            return 2 * s.matched / std::max(1.0, 2 * s.matched + s.missed + s.false_positives);
        },
        options);
    result.mota = bootstrap(
        units,
        [&](const std::vector<int>& counts) {
            const Sums s = drawnSums(tallies, counts);
            return 1 - (s.missed + s.false_positives + s.switches) / std::max(1.0, s.matched + s.missed);
        },
        options);
    return result;
}

}  // namespace eyrie
