#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "scoring/scoring.h"
#include "sweep/plan/sweep_plan.h"
#include "sweep/results/sweep_figures.h"
#include "sweep/stage_cache.h"

namespace eyrie {

/// A sequence of the plan, opened.
struct SweepInput {
    std::unique_ptr<StageCache> cache;
    Scoring scoring;
};

/// A point that was measured.
struct SweepPoint {
    int position = 0;
    double seconds = 0;  ///< wall clock, with what it shares with others if it came first
    std::vector<SweepFigures> figures;
};

/// How far a sweep is.
struct SweepProgress {
    int points_done = 0;
    int points_total = 0;
    double seconds = 0;
    double points_per_second = 0;  ///< 0 until known
    double seconds_left = 0;       ///< 0 until known
    std::string doing;             ///< what all points wait for: "independent motion, frame 120 of 401"; else empty
};

/// How a sweep is run, and who is told.
struct SweepRunOptions {
    int threads = 0;                                  ///< 0: as many as there are cores
    std::function<void(const SweepPoint&)> on_point;  ///< one call at a time, from any thread; what it throws ends
                                                      ///< the sweep
    std::function<void(const SweepProgress&)> on_progress{};  ///< likewise; must not throw
};

/// Measures the points at `positions` (in this order, several at once) and answers how many; fewer than asked for when
/// `stop` was requested. `inputs` belong to the plan's clips. What was handed to `on_point` is done whatever happens
/// later. Throws Error(input | parameter) and what `on_point` throws.
int runSweep(const SweepPlan& plan, const std::vector<SweepInput>& inputs, const std::vector<int>& positions,
             const std::stop_token& stop, const SweepRunOptions& options);

}  // namespace eyrie
