#include "tracking/pictures/light_telling.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/geometry/angle.h"

namespace eyrie {
namespace {

/// The stretches, without what is in them.
std::vector<LightFinding> stretchesOf(const GroundTurns& turns) {
    std::vector<LightFinding> stretches;
    for (FrameIndex frame = turns.firstFrame(); frame <= turns.lastFrame(); ++frame) {
        const FrameIndex stretch = turns.at(frame).stretch;
        if (stretches.empty() || stretches.back().first_frame != stretch) {
            LightFinding& begun = stretches.emplace_back();
            begun.first_frame = stretch;
            begun.outcome = LightOutcome::few_vehicles;
        }
        stretches.back().last_frame = frame;
    }
    return stretches;
}

LightFinding* findingIn(std::vector<LightFinding>& stretches, FrameIndex stretch) {
    const auto found =
        std::lower_bound(stretches.begin(), stretches.end(), stretch,
                         [](const LightFinding& finding, FrameIndex wanted) { return finding.first_frame < wanted; });
    return found != stretches.end() && found->first_frame == stretch ? &*found : nullptr;
}

void tellReading(const StretchLight& read, LightFinding& finding) {
    finding.outcome = read.outcome;
    finding.vehicles = read.shadow.tracks;
    if (read.outcome == LightOutcome::few_vehicles) return;
    if (read.outcome == LightOutcome::shadows)
        finding.heading = std::atan2(read.shadow.reach_m.y, read.shadow.reach_m.x);
    finding.reach_m = std::hypot(read.shadow.reach_m.x, read.shadow.reach_m.y);
    finding.scatter_m = read.scatter_m;
    finding.agreement = read.shadow.agreement;
    finding.darkening = read.darkening;
}

/// One after the other in which nothing was found for the same reason: what the one with most vehicles says.
std::vector<LightFinding> joined(const std::vector<LightFinding>& stretches) {
    std::vector<LightFinding> findings;
    for (const LightFinding& stretch : stretches) {
        const bool alike =
            !findings.empty() && stretch.outcome != LightOutcome::shadows && findings.back().outcome == stretch.outcome;
        if (!alike) {
            findings.push_back(stretch);
            continue;
        }
        LightFinding& last = findings.back();
        const FrameIndex first_frame = last.first_frame;
        if (stretch.vehicles > last.vehicles) last = stretch;
        last.first_frame = first_frame;
        last.last_frame = stretch.last_frame;
    }
    return findings;
}

}  // namespace

RunLight untoldLight(const std::vector<TrackPath>& paths, LightOutcome why) {
    if (paths.empty()) return {};
    LightFinding finding;
    finding.outcome = why;
    finding.first_frame = paths.front().firstFrame();
    finding.last_frame = paths.front().lastFrame();
    for (const TrackPath& path : paths) {
        finding.first_frame = std::min(finding.first_frame, path.firstFrame());
        finding.last_frame = std::max(finding.last_frame, path.lastFrame());
    }
    return {{finding}, {}, {}};
}

RunLight toldShadows(const std::vector<StretchLight>& read, const GroundTurns& turns, const SceneScale& scale,
                     const std::vector<TrackPath>& paths, std::map<TrackId, BoxTrim> trims,
                     const std::vector<TrackPath>& shadows) {
    RunLight light;
    std::vector<LightFinding> stretches = stretchesOf(turns);
    for (const StretchLight& each : read) {
        if (LightFinding* finding = findingIn(stretches, each.shadow.stretch)) tellReading(each, *finding);
    }
    for (const TrackPath& path : paths) {
        if (!trims.contains(path.id)) continue;
        std::set<FrameIndex> lives_in;
        for (const auto& [frame, state] : path.states) lives_in.insert(turns.at(frame).stretch);
        for (const FrameIndex stretch : lives_in) {
            LightFinding* finding = findingIn(stretches, stretch);
            if (finding != nullptr && finding->outcome == LightOutcome::shadows) ++finding->trimmed;
        }
    }
    for (const TrackPath& path : shadows) {
        const FrameIndex middle = path.states[path.states.size() / 2].first;
        if (LightFinding* finding = findingIn(stretches, turns.at(middle).stretch)) ++finding->dropped;
    }
    for (const LightFinding& finding : stretches) {
        if (finding.outcome != LightOutcome::shadows) continue;
        for (FrameIndex frame = finding.first_frame; frame <= finding.last_frame; ++frame) {
            const GroundTurns::Turn& turn = turns.at(frame);
            light.frames.push_back({frame, wrapPi(finding.heading + turn.angle),
                                    scale.in(turn.stretch).px(finding.reach_m) * turn.enlargement});
        }
    }
    light.findings = joined(stretches);
    light.trims = std::move(trims);
    return light;
}

RunLight toldBeams(BeamFinding beams, const GroundTurns& turns) {
    LightFinding finding;
    finding.first_frame = turns.firstFrame();
    finding.last_frame = turns.lastFrame();
    finding.outcome = LightOutcome::beams;
    finding.vehicles = beams.vehicles;
    finding.trimmed = static_cast<int>(beams.trims.size());
    return {{finding}, {}, std::move(beams.trims)};
}

}  // namespace eyrie
