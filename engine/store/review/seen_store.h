#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/review/seen_frames.h"
#include "store/project/project_file.h"

namespace eyrie {

/// Adds frames that a person watched to what she saw of a video before, in one transaction. Any number of windows may
/// do so at once; no right to judge is needed, and nothing of it can be undone. Throws Error(project | output).
void addSeen(ProjectFile& project, int sequence_id, const std::string& person, const std::vector<FrameSpan>& seen);

/// What each person watched of a video, merged. Throws Error(project).
std::map<std::string, std::vector<FrameSpan>> seenBy(ProjectFile& project, int sequence_id);
/// What anybody watched, merged.
std::vector<FrameSpan> seenByAnybody(ProjectFile& project, int sequence_id);

}  // namespace eyrie
