#pragma once

#include <string>

#include "store/project/project_file.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// Whether a run kept what is behind its tracks of a frame: motion vectors, corners, clusters, search areas,
/// detections. Where not, frameResult() has none of them, whatever was found. True for a frame that the run does not
/// have. Throws Error(project).
bool hasDetails(ProjectFile& project, int run_id, FrameIndex frame);
/// Of how many of its frames.
int detailedFrames(ProjectFile& project, int run_id);
/// What to tell whoever needs the details of all frames of a run that keeps those of `kept` only, and what to do.
std::string lackOfDetails(const RunRecord& run, int kept);
/// Throws Error(input) with that, unless the run keeps the details of all frames it has done.
void needDetails(ProjectFile& project, const RunRecord& run);

}  // namespace eyrie
