#pragma once

#include <string>

#include "store/project/project_file.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// Tells how far a run and its video reach so far, where that is not known before: of a live source. Throws
/// Error(project | output).
void setEnd(ProjectFile& project, int run_id, FrameIndex last);
/// What there is to say of a run that is no error, for people. Throws Error(project | output).
void setRemark(ProjectFile& project, int run_id, const std::string& remark);

}  // namespace eyrie
