#pragma once

#include "core/labels/box_record.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// What people labelled of a run's video, as boxes to measure the run by: interpolated over the ground as the run
/// registered it, all frames of the video. Throws Error(project) when the project has no labels of that video.
BoxesByFrame labelTruth(ProjectFile& project, const RunRecord& run);

}  // namespace eyrie
