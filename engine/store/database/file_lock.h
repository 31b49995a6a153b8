#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace eyrie {

/// A lock on a file of its own beside what it guards. The system releases it when the process ends, however it ends.
/// The file says who holds it and vanishes when the lock is released in order; one that a killed process left means
/// nothing.
class FileLock {
 public:
    /// Impossible: the file cannot be made, or its file system knows no locks.
    enum class Outcome { taken, held, impossible };
    struct Attempt;

    /// Never waits. Held once by one process, too.
    static Attempt tryTake(const std::filesystem::path& file);
    /// Who holds the lock now ("process 4711 on oak (since 2026-11-21T08:00:00Z)"); nothing when nobody does. Takes
    /// nothing and makes no file.
    static std::optional<std::string> holderOf(const std::filesystem::path& file);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

 private:
    FileLock(std::filesystem::path path, int descriptor);
    std::filesystem::path path_;
    int descriptor_;
};

/// What came of trying.
struct FileLock::Attempt {
    Outcome outcome = Outcome::impossible;
    std::unique_ptr<FileLock> lock;  ///< if taken
    /// If held: who holds it, as holderOf() says; if impossible: what went wrong, naming the file.
    std::string words;
};

/// "clip.eyrie" → "/videos/clip.eyrie.labelling", the same for every way to name the file. Where that name would be too
/// long for a file system, its end gives way to a number made from the whole of it.
std::filesystem::path lockFileBeside(const std::filesystem::path& guarded, const std::string& ending);

}  // namespace eyrie
