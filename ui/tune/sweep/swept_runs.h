#pragma once

#include <filesystem>
#include <stop_token>
#include <vector>

#include "sweep/clip_opening.h"

namespace eyrie::ui {

/// A stored run that is to be swept.
struct RunToSweep {
    int run_id = 0;
    GroundTruthSource truth{};
    EvaluationOptions wishes{};
};

/// Stored runs opened for a sweep, with their motion vectors.
struct OpenedRuns : OpenedClips {
    ChainOptions options;  ///< of the first
};
/// Throws Error, also where one file of true boxes is to serve runs of several videos.
OpenedRuns openRunsForSweep(const std::filesystem::path& project, const std::vector<RunToSweep>& runs,
                            const std::stop_token& stop);

}  // namespace eyrie::ui
