#pragma once

#include "core/error.h"
#include "core/parameter.h"
#include "store/runs/run_store.h"
#include "store/runs/track_scale.h"

namespace eyrie {

/// How a run tells classes: its scale and its limits. A run of before there were any has the defaults.
struct ClassRule {
    SceneScale scale;
    TrackClassOptions limits;

    TrackClass of(const TrackSummary& track) const {
        return classOf({track.frames, track.mean_length_px, track.mean_width_px, track.mean_speed_px},
                       scaleOf(track, scale), limits);
    }
};

/// By the scale and the parameters that the run is stored with; the defaults for what an older one lacks.
inline ClassRule classRuleOf(const RunStore& store, int run_id) {
    ClassRule rule;
    const std::optional<RunRecord> run = store.run(run_id);
    if (!run) return rule;
    rule.scale = run->scale;
    for (const auto& [name, value] : store.parameters(run_id)) {
        if (!name.starts_with("classes.")) continue;
        try {
            setParameter(describeOf(rule.limits), name, value);
        } catch (const Error&) {
            // Another version wrote it; the default holds, as for all parameters of a run.
        }
    }
    return rule;
}

}  // namespace eyrie
