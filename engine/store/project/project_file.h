#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace SQLite {
class Database;
}

namespace eyrie {

/// A project: one SQLite file. Opened here and nowhere else; knows its application id, its schema number and how to
/// migrate older files. Not thread-safe: every thread opens its own.
class ProjectFile {
 public:
    enum class Mode { read_write, read_only };

    /// Bytes that a row holds at most, in all its columns; a frame's arrays have some hundred thousand.
    static constexpr std::size_t kLongestRow = std::size_t{1} << 28;

    /// Makes a new project; never replaces a file, also not one that another program makes at this moment. A log that a
    /// deleted project left there is put aside. Throws Error(output) when the file exists or its folder cannot be
    /// written.
    static ProjectFile create(const std::filesystem::path& path);
    /// Opens an existing project and migrates it, in either mode, if it is older, keeping a copy of it before
    /// (project_backup.h). Throws Error(project) when it is missing, cannot be read, is no project, is damaged, or was
    /// written by a newer version.
    static ProjectFile open(const std::filesystem::path& path, Mode mode = Mode::read_write);
    /// Opens a project or makes it. Two programs that do so at once share one project.
    static ProjectFile openOrCreate(const std::filesystem::path& path);

    ProjectFile(ProjectFile&&) noexcept;
    ProjectFile& operator=(ProjectFile&&) noexcept;
    ~ProjectFile();

    const std::filesystem::path& path() const { return path_; }
    /// As it was opened; what is read-only stays as it is, whoever could write it.
    Mode mode() const { return mode_; }
    /// What should be told about opening it: that no copy could be kept before it was migrated. Empty when all is well.
    const std::string& notice() const { return notice_; }
    SQLite::Database& database() { return *database_; }
    /// Throws Error(project) when the file was deleted, moved or replaced meanwhile: what is written would be lost.
    void checkInPlace() const;

 private:
    ProjectFile(std::filesystem::path path, Mode mode, std::unique_ptr<SQLite::Database> database);
    std::filesystem::path path_;
    Mode mode_;
    std::string notice_;
    std::unique_ptr<SQLite::Database> database_;
};

}  // namespace eyrie
