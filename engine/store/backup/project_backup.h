#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "store/backup/database_copy.h"
#include "store/database/file_lock.h"

/// Copies of a project's earlier states, kept in a hidden folder beside it (".eyrie-backups/clip.eyrie/"): the newest
/// five. Each is a project itself, of one file that is write-protected. The project need not be there any more to find
/// them.
namespace eyrie {

inline constexpr int kBackupsKept = 5;

using UtcTime = std::chrono::sys_seconds;
/// The present time, whole seconds.
UtcTime utcNow();
/// "2026-11-21 08:00:00 UTC".
std::string inWords(UtcTime time);

/// Why a state was kept.
enum class BackupReason { daily, before_migration, before_restoring };
/// For people: "first use that day".
const char* nameOf(BackupReason reason);

/// One kept state.
struct ProjectBackup {
    std::filesystem::path path;
    UtcTime made{};
    BackupReason reason = BackupReason::daily;
    std::uintmax_t bytes = 0;
    /// By which commands name it: "2026-11-21T08-00-00Z-daily".
    std::string name() const { return path.stem().string(); }
};

/// Newest first; none when there is no folder of them or it cannot be read.
std::vector<ProjectBackup> listBackups(const std::filesystem::path& project);
/// The folder in which the copies of a project lie, whether it is there or not.
std::filesystem::path backupFolderOf(const std::filesystem::path& project);

/// What came of making a copy of a project.
enum class BackupOutcome {
    made,
    not_due,    ///< the newest copy is of this day, or nothing has changed since
    by_others,  ///< another program makes one at this moment
    stopped,    ///< by the watch
    impossible  ///< see the notice
};
/// The copy that was made, or why there is none.
struct BackupResult {
    BackupOutcome outcome = BackupOutcome::not_due;
    std::optional<ProjectBackup> backup;  ///< if made
    std::string notice;                   ///< for people: why there is none, and what to do; empty when all is well
};

/// What to keep, and how.
struct BackupRequest {
    BackupReason reason = BackupReason::before_restoring;
    CopyWatch watch = {};
    UtcTime now = utcNow();
    std::filesystem::path spared = {};       ///< a copy that is not dropped, however old
    SQLite::Database* connection = nullptr;  ///< to the project, for one who has locked it; else one is opened
};

/// Keeps the present state, whatever others write meanwhile, and drops the oldest copies beyond kBackupsKept. Takes
/// seconds for large projects. Whatever goes wrong is told in the result; nothing half stays.
BackupResult backUp(const std::filesystem::path& project, const BackupRequest& request);

/// Keeps the present state once a day (UTC) of use; called by every program that begins to write. A damaged project is
/// not kept, so that it does not push out good copies: the notice tells.
BackupResult backUpIfDue(const std::filesystem::path& project, const CopyWatch& watch = {}, UtcTime now = utcNow());

/// Keeps a project of an older schema. While `lock` is held, other programs that would migrate it wait.
struct MigrationBackup {
    BackupResult result;
    std::unique_ptr<FileLock> lock;
};
MigrationBackup backUpBeforeMigrating(const std::filesystem::path& project);

}  // namespace eyrie
