#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/values/ids.h"
#include "store/project/project_file.h"

namespace eyrie {

/// Tracks of a run that an annotator rejected as objects: they are not offered again, in this window or any other.
/// Whoever writes has the right to label. All throw Error(project | output).
std::set<TrackId> rejectedProposals(ProjectFile& project, int run_id);
/// Adds some, in one transaction; those that were rejected before stay as they are.
void rejectProposals(ProjectFile& project, int run_id, const std::vector<TrackId>& tracks, const std::string& person);
/// All of a run are offered again.
void forgetRejectedProposals(ProjectFile& project, int run_id);

}  // namespace eyrie
