#include "tracking/pictures/headlight_beams.h"

#include <algorithm>
#include <map>

namespace eyrie {
namespace {

constexpr std::size_t kFewestLookedAt = 2;  ///< times a track is
constexpr double kClearBeam = 0.1;          ///< share of the length
constexpr int kFewestLit = 3;               ///< tracks that have a beam …
constexpr double kLeastLit = 0.25;     ///< … and least share of those that were looked at, since by day few look so
constexpr double kLampsWithin = 0.06;  ///< share of the length by which lamps lie behind the front
constexpr double kLongestOut = 0.5;    ///< share of the length that is taken out at most

std::map<TrackId, double> beamsByTrack(const std::vector<SilhouetteLook>& looks) {
    return usualByTrack(looks, &SilhouetteLook::beam, kFewestLookedAt);
}

/// How many have one; 0 where they are too few, as by day.
int litOf(const std::map<TrackId, double>& beams) {
    const auto lit =
        std::count_if(beams.begin(), beams.end(), [](const auto& beam) { return beam.second >= kClearBeam; });
    const bool enough = lit >= kFewestLit && static_cast<double>(lit) >= kLeastLit * static_cast<double>(beams.size());
    return enough ? static_cast<int>(lit) : 0;
}

}  // namespace

bool driveWithHeadlights(const std::vector<SilhouetteLook>& looks) {
    return litOf(beamsByTrack(looks)) > 0;
}

BeamFinding takeOutBeams(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks) {
    const std::map<TrackId, double> beams = beamsByTrack(looks);
    BeamFinding finding{litOf(beams), {}};
    if (finding.vehicles == 0) return finding;
    for (TrackPath& path : paths) {
        const auto beam = beams.find(path.id);
        if (beam == beams.end()) continue;
        const double share = std::clamp(beam->second - kLampsWithin, 0.0, kLongestOut);
        if (share > 0) finding.trims[path.id] = {LightOutcome::beams, share, 0, share};
        for (auto& [frame, state] : path.states) {
            const OrientedBox box = state.box;
            const double out = share * box.length;
            state.box = OrientedBox{box.toImage({-out / 2, 0}), box.length - out, box.width, box.heading};
        }
    }
    return finding;
}

}  // namespace eyrie
