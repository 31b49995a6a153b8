#include "store/runs/run_lock.h"

#include <string>

namespace eyrie {

std::filesystem::path runLockFile(const std::filesystem::path& project, int run_id) {
    return lockFileBeside(project, ".run-" + std::to_string(run_id));
}

void clearRunLock(const std::filesystem::path& project, int run_id) {
    const std::filesystem::path file = runLockFile(project, run_id);
    std::error_code ignored;
    // Whoever releases a lock removes its file.
    if (std::filesystem::exists(file, ignored)) FileLock::tryTake(file);
}

}  // namespace eyrie
