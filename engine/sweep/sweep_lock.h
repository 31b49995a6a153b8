#pragma once

#include <memory>

#include "store/database/file_lock.h"
#include "store/project/project_file.h"

namespace eyrie {

/// The right to work on a sweep of a project, so that two windows, or a window and the command line, do not do the same
/// points. Ends with the process, however that ends. Null where the place of the project knows no locks. Throws
/// Error(project) naming who works on it.
std::unique_ptr<FileLock> lockSweep(const ProjectFile& project, int sweep);

}  // namespace eyrie
