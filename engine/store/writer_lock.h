#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace eyrie {

/// The right to label a project: held by one window at a time. A lock on a file beside the project
/// ("clip.eyrie.labelling"), which the system releases when the process ends, however it ends; SQLite's own locks are
/// not touched. The file says who holds it and vanishes when the lock is released in order.
class WriterLock {
 public:
    /// Takes the lock, or answers nothing with the reason for people in `reason` ("process 4711 on host oak has
    /// labelled it since 2026-11-21T08:00:00Z"; a folder that cannot be written is a reason, too).
    static std::unique_ptr<WriterLock> tryTake(const std::filesystem::path& project, std::string& reason);
    ~WriterLock();
    WriterLock(const WriterLock&) = delete;
    WriterLock& operator=(const WriterLock&) = delete;

 private:
    WriterLock(std::filesystem::path path, int descriptor);
    std::filesystem::path path_;
    int descriptor_;
};

}  // namespace eyrie
