#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "store/database/file_lock.h"

namespace eyrie {

/// The right to label or to review a project: held by one window at a time, by a lock on a file beside the project
/// ("clip.eyrie.labelling", "clip.eyrie.reviewing"); SQLite's own locks are not touched.
class WriterLock {
 public:
    enum class Work { labels, review };

    /// Takes the lock, or answers nothing with the reason for people in `reason` ("process 4711 on host oak has
    /// labelled it since 2026-11-21T08:00:00Z"; a folder that cannot be written is a reason, too).
    static std::unique_ptr<WriterLock> tryTake(const std::filesystem::path& project, std::string& reason,
                                               Work work = Work::labels);
    /// "the labels are read-only", for messages.
    static const char* readOnlyWords(Work work);
    /// Who has one of these rights now; nothing when nobody has. Takes nothing.
    static std::optional<std::string> holderOf(const std::filesystem::path& project);

 private:
    explicit WriterLock(std::unique_ptr<FileLock> lock) : lock_(std::move(lock)) {}
    std::unique_ptr<FileLock> lock_;
};

}  // namespace eyrie
