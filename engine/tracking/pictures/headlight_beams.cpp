#include "tracking/pictures/headlight_beams.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/robust_statistics.h"

namespace eyrie {
namespace {

constexpr std::size_t kFewestLookedAt = 2;  ///< times a track is
constexpr double kClearBeam = 0.1;          ///< share of the length
constexpr int kFewestLit = 3;               ///< tracks that have a beam …
constexpr double kLeastLit = 0.25;          ///< … and least share of those looked at, since by day few look so …
constexpr double kFewerInDark = 0.15;       ///< … but less by so much where it is fully dark …
constexpr double kSurelyDark = 0.5;         ///< … and a single one is enough in more than half of that
constexpr double kLampsWithin = 0.06;       ///< share of the length by which lamps lie behind the front
constexpr double kLongestOut = 0.5;         ///< share of the length that is taken out at most
/// Lit ground that the picture does not show as such, where it is fully dark: share of the length ahead of a vehicle …
constexpr double kUnseenAhead = 0.12;
constexpr double kUnseenBeside = 0.25;  ///< … and of the width, on both sides together …
constexpr double kSlenderest = 2.6;     ///< … but of no box that is so many times as long as wide: it holds a part

double usualDarkness(const std::vector<SilhouetteLook>& looks) {
    if (looks.empty()) return 0;
    std::vector<double> of_pictures;
    of_pictures.reserve(looks.size());
    for (const SilhouetteLook& look : looks) of_pictures.push_back(look.darkness);
    return medianOf(std::move(of_pictures));
}

std::map<TrackId, double> beamsByTrack(const std::vector<SilhouetteLook>& looks) {
    return usualByTrack(looks, &SilhouetteLook::beam, kFewestLookedAt);
}

/// How many have one; 0 where they are too few, as by day.
int litOf(const std::map<TrackId, double>& beams, double darkness) {
    const auto lit =
        std::count_if(beams.begin(), beams.end(), [](const auto& beam) { return beam.second >= kClearBeam; });
    const int fewest = darkness > kSurelyDark ? 1 : kFewestLit;
    const double least = kLeastLit - darkness * kFewerInDark;
    const bool enough = lit >= fewest && static_cast<double>(lit) >= least * static_cast<double>(beams.size());
    return enough ? static_cast<int>(lit) : 0;
}

/// How many times its boxes are as long as wide.
double usualSlenderness(const TrackPath& path) {
    std::vector<double> ratios;
    ratios.reserve(path.states.size());
    for (const auto& [frame, state] : path.states) ratios.push_back(state.box.length / std::max(1.0F, state.box.width));
    return medianOf(std::move(ratios));
}

}  // namespace

bool driveWithHeadlights(const std::vector<SilhouetteLook>& looks) {
    return litOf(beamsByTrack(looks), usualDarkness(looks)) > 0;
}

BeamFinding takeOutBeams(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks) {
    const std::map<TrackId, double> beams = beamsByTrack(looks);
    const double darkness = usualDarkness(looks);
    BeamFinding finding{litOf(beams, darkness), {}};
    if (finding.vehicles == 0) return finding;
    for (TrackPath& path : paths) {
        const auto beam = beams.find(path.id);
        const double seen = beam == beams.end() ? 0 : std::max(beam->second - kLampsWithin, 0.0);
        const double ahead = std::min(seen + darkness * kUnseenAhead, kLongestOut);
        const double slender = usualSlenderness(path);
        const double beside = darkness * std::clamp(1 - slender / kSlenderest, 0.0, kUnseenBeside);
        if (ahead == 0 && beside == 0) continue;
        finding.trims[path.id] = {LightOutcome::beams, ahead, beside, 1 - (1 - ahead) * (1 - beside)};
        for (auto& [frame, state] : path.states) {
            const OrientedBox box = state.box;
            const double out = ahead * box.length;
            state.box =
                OrientedBox{box.toImage({-out / 2, 0}), box.length - out, (1 - beside) * box.width, box.heading};
        }
    }
    return finding;
}

}  // namespace eyrie
