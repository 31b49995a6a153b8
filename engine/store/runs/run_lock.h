#pragma once

#include <filesystem>

#include "store/database/file_lock.h"

namespace eyrie {

/// The file whose lock says that a program writes this run at this moment ("clip.eyrie.run-3"). The writer takes it
/// before others can see the run, so that a run in the state `running` without the lock was killed.
std::filesystem::path runLockFile(const std::filesystem::path& project, int run_id);

/// Removes such a file that a killed program left, unless a program writes the run.
void clearRunLock(const std::filesystem::path& project, int run_id);

}  // namespace eyrie
