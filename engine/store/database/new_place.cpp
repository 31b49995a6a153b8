#include "store/database/new_place.h"

#include <chrono>
#include <string>
#include <thread>

#include "core/error.h"
#include "core/time/utc_time.h"
#include "store/health/file_check.h"

namespace eyrie {
namespace {

using Path = std::filesystem::path;

constexpr auto kPlacePatience = std::chrono::seconds(5);

/// SQLite would take a log that a deleted or moved project left for the new one's.
void clearCompanions(const Path& path) {
    std::error_code ignored;
    if (hasLog(path)) {
        const Path kept = lockFileBeside(path, "-wal.left-" + nowUtc());
        std::filesystem::rename(path.string() + "-wal", kept, ignored);
    }
    for (const char* ending : {"-journal", "-wal", "-shm"}) std::filesystem::remove(path.string() + ending, ignored);
}

/// Held so that nobody's log is taken for a left one.
std::unique_ptr<FileLock> lockMaking(const Path& path) {
    const Path file = lockFileBeside(path, ".making");
    const auto end = std::chrono::steady_clock::now() + kPlacePatience;
    for (;;) {
        FileLock::Attempt attempt = FileLock::tryTake(file);
        // Where nothing can be locked the file itself is still made without replacing one.
        if (attempt.outcome != FileLock::Outcome::held) return std::move(attempt.lock);
        if (std::chrono::steady_clock::now() > end) {
            throw Error(ErrorKind::project,
                        attempt.words + " is making the project " + path.string() + " at this moment; try again");
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

}  // namespace

NewPlace::NewPlace(const Path& path) : making_(lockMaking(path)) {
    std::error_code failed;
    free_ = !std::filesystem::exists(std::filesystem::symlink_status(path, failed));
    if (free_) clearCompanions(path);
}

}  // namespace eyrie
