#pragma once

#include <filesystem>
#include <stop_token>

#include "sweep/clip_opening.h"

namespace eyrie::ui {

/// A stored run opened for a sweep, with its motion vectors. `clip.ground_truth` names a file of labels in any known
/// format; empty: the labels of the project. Throws Error.
struct OpenedRun {
    SweepClip clip;
    ChainOptions options;  ///< of the run
    std::vector<SweepInput> inputs;
};
OpenedRun openRunForSweep(const std::filesystem::path& project, int run_id, const std::filesystem::path& truth_file,
                          bool upright, const std::stop_token& stop);

}  // namespace eyrie::ui
