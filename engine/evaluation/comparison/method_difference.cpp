#include "evaluation/comparison/method_difference.h"

#include <algorithm>

#include "core/error.h"

namespace eyrie {
namespace {

constexpr int kNoId = -1;

int idOf(const BoxRecord& record) {
    return record.id.value_or(kNoId);
}

UnitTally drawnTally(const PairedTallies& tallies, const std::vector<int>& counts) {
    UnitTally sum;
    for (std::size_t i = 0; i < tallies.units.size(); ++i) {
        const double times = counts[i];
        sum.matched += times * tallies.units[i].matched;
        sum.missed += times * tallies.units[i].missed;
        sum.switches += times * tallies.units[i].switches;
        sum.false_positives += times * tallies.units[i].false_positives;
    }
    return sum;
}

double fScore(const UnitTally& sum) {
    return 2 * sum.matched / std::max(1.0, 2 * sum.matched + sum.missed + sum.false_positives);
}

double mota(const UnitTally& sum) {
    return 1 - (sum.missed + sum.false_positives + sum.switches) / std::max(1.0, sum.matched + sum.missed);
}

}  // namespace

PairedTallies pairedTallies(const BoxesByFrame& truth, const std::vector<FrameMatch>& matches,
                            const TrackTallies* tracks, std::pair<FrameIndex, FrameIndex> frames, int block_frames) {
    const int block = std::max(1, block_frames);
    std::map<int, UnitTally> by_track;
    for (const auto& [frame, records] : truth) {
        for (const BoxRecord& record : records) by_track[idOf(record)];
    }
    std::vector<UnitTally> blocks(static_cast<std::size_t>(std::max(0, frames.second - frames.first) / block + 1));
    for (const FrameMatch& match : matches) {
        if (!match.pairs.empty() || !match.missed.empty()) {
            const std::vector<BoxRecord>& records = truth.at(match.frame);
            for (const MatchedPair& pair : match.pairs)
                by_track[idOf(records[static_cast<std::size_t>(pair.truth)])].matched += 1;
            for (const int missed : match.missed) by_track[idOf(records[static_cast<std::size_t>(missed)])].missed += 1;
        }
        const int at = std::clamp(match.frame - frames.first, 0, std::max(0, frames.second - frames.first)) / block;
        blocks[static_cast<std::size_t>(at)].false_positives += static_cast<double>(match.false_results.size());
    }
    PairedTallies paired;
    paired.has_switches = tracks != nullptr;
    if (tracks != nullptr) {
        for (const TruthTrackTally& track : tracks->truth) {
            const auto own = by_track.find(track.id);
            if (own != by_track.end()) own->second.switches += track.switches;
        }
    }
    for (const auto& [id, tally] : by_track) paired.units.push_back(tally);
    paired.units.insert(paired.units.end(), blocks.begin(), blocks.end());
    return paired;
}

MethodDifference methodDifference(const PairedTallies& a, const PairedTallies& b, const BootstrapOptions& options) {
    if (a.units.size() != b.units.size()) {
        throw Error(ErrorKind::input, "methods can only be compared on the same ground truth and frames");
    }
    const int units = static_cast<int>(a.units.size());
    MethodDifference difference;
    difference.f_score = bootstrap(
        units,
        [&](const std::vector<int>& counts) { return fScore(drawnTally(a, counts)) - fScore(drawnTally(b, counts)); },
        options);
    if (a.has_switches && b.has_switches) {
        difference.mota = bootstrap(
            units,
            [&](const std::vector<int>& counts) { return mota(drawnTally(a, counts)) - mota(drawnTally(b, counts)); },
            options);
    }
    return difference;
}

BootstrapInterval fScoreInterval(const PairedTallies& tallies, const BootstrapOptions& options) {
    return bootstrap(
        static_cast<int>(tallies.units.size()),
        [&](const std::vector<int>& counts) { return fScore(drawnTally(tallies, counts)); }, options);
}

}  // namespace eyrie
