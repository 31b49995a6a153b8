#pragma once

#include <filesystem>
#include <memory>

#include "store/database/file_lock.h"

namespace eyrie {

/// Where a project is to be made. While it lives, no other program makes one there, and nothing that an old one left
/// lies there: a log with contents is kept under another name, since it may hold the only copy of somebody's work.
class NewPlace {
 public:
    /// Throws Error(project) when another program makes a project there and does not come to an end.
    explicit NewPlace(const std::filesystem::path& path);
    /// False when there is a file.
    bool isFree() const { return free_; }

 private:
    std::unique_ptr<FileLock> making_;
    bool free_ = false;
};

}  // namespace eyrie
