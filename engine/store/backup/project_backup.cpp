#include "store/backup/project_backup.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "store/backup/backup_name.h"
#include "store/database/busy_timeout.h"
#include "store/database/database_error.h"
#include "store/database/stop_handler.h"
#include "store/project/schema.h"

namespace eyrie {
namespace {

using Path = std::filesystem::path;

constexpr char kPartial[] = ".partial-";
constexpr auto kMigrationPatience = std::chrono::seconds(60);

std::uintmax_t sizeOf(const Path& file) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(file, missing);
    return missing ? 0 : size;
}

std::string megabytes(std::uintmax_t bytes) {
    return std::to_string((bytes + 999'999) / 1'000'000) + " MB";
}

BackupResult impossible(const Path& project, const std::string& why) {
    return {BackupOutcome::impossible, std::nullopt,
            "no copy of the present state of " + project.string() + " was kept: " + why};
}

/// Whether a file, where it is, was written later.
bool changedAfter(const Path& file, UtcTime time) {
    struct stat facts {};
    return stat(file.c_str(), &facts) == 0 &&
           std::chrono::sys_seconds(std::chrono::seconds(facts.st_mtim.tv_sec)) >= time;
}

bool isDue(const Path& project, UtcTime now) {
    const std::vector<ProjectBackup> kept = listBackups(project);
    const auto today = std::chrono::floor<std::chrono::days>(now);
    for (const ProjectBackup& backup : kept) {
        if (std::chrono::floor<std::chrono::days>(backup.made) == today) return false;
    }
    return kept.empty() || changedAfter(project, kept.front().made) ||
           changedAfter(project.string() + "-wal", kept.front().made);
}

bool holdsNothing(SQLite::Database& database) {
    return database
               .execAndGet(
                   "SELECT EXISTS (SELECT 1 FROM sequence) OR EXISTS (SELECT 1 FROM preset) OR EXISTS (SELECT 1 "
                   "FROM sweep) OR EXISTS (SELECT 1 FROM comparison)")
               .getInt() == 0;
}

/// Whether SQLite finds nothing wrong with the structure of a database. Throws SQLite::Exception, also when stopped.
bool isSound(const Path& copy, const std::stop_token& stop) {
    SQLite::Database database(copy.string(), SQLite::OPEN_READONLY);
    const StopHandler handler(database, stop);
    return database.execAndGet("PRAGMA quick_check(1)").getString() == "ok";
}

/// The last step: the name that counts. Two copies of one second get two names.
std::error_code takeItsName(const Path& partial, ProjectBackup& backup, const Path& folder) {
    for (;; backup.made += std::chrono::seconds(1)) {
        backup.path = folder / backupFileName(backup.made, backup.reason);
        const std::error_code failed = renameWithoutReplacing(partial, backup.path);
        if (failed != std::errc::file_exists) return failed;
    }
}

void removePartials(const Path& folder) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        if (entry.path().filename().string().starts_with(kPartial)) std::filesystem::remove(entry.path(), ignored);
    }
}

void dropOldest(const Path& project, const Path& spared) {
    std::vector<ProjectBackup> kept = listBackups(project);
    std::error_code ignored;
    for (std::size_t i = kBackupsKept; i < kept.size(); ++i) {
        if (kept[i].path != spared) std::filesystem::remove(kept[i].path, ignored);
    }
}

BackupResult damaged(const Path& project) {
    return impossible(project, "it is damaged; look at it with eyrie-cli check, and at its earlier states");
}

/// Fills the partial copy; answers why not.
std::optional<BackupResult> fill(const Path& partial, const Path& project, const BackupRequest& request) {
    const bool daily = request.reason == BackupReason::daily;
    const BackupResult stopped{BackupOutcome::stopped, std::nullopt, {}};
    try {
        {
            std::unique_ptr<SQLite::Database> own;
            if (request.connection == nullptr) {
                own = std::make_unique<SQLite::Database>(project.string(), SQLite::OPEN_READWRITE, kBusyTimeoutMs);
                own->exec("PRAGMA query_only = ON");
            }
            SQLite::Database& source = own ? *own : *request.connection;
            if (daily && holdsNothing(source)) return BackupResult{};
            SQLite::Database target(partial.string(), SQLite::OPEN_READWRITE);
            if (!copyDatabase(source, target, request.watch)) return stopped;
        }
        settleCopy(partial, !daily);
        if (daily && !isSound(partial, request.watch.stop)) return damaged(project);
    } catch (const SQLite::Exception& exception) {
        switch (exception.getErrorCode()) {
            case SQLITE_INTERRUPT:
                return stopped;
            case SQLITE_CORRUPT:
            case SQLITE_NOTADB:
                return damaged(project);
            default:
                return impossible(project, databaseError(partial, "copying the project", exception).what());
        }
    }
    return std::nullopt;
}

/// Makes the copy. Whoever calls holds the folder's lock where there can be one.
BackupResult keep(const Path& project, const BackupRequest& request) {
    const Path folder = backupFolderOf(project);
    const std::uintmax_t size = sizeOf(project) + sizeOf(project.string() + "-wal");
    std::error_code failed;
    const auto space = std::filesystem::space(folder, failed);
    if (!failed && space.available / 2 < size) {
        return impossible(project, "only " + megabytes(space.available) + " are free for a copy of " + megabytes(size) +
                                       "; free some space");
    }
    const auto refuse = [&](const std::error_code& why) {
        return impossible(project, folder.string() + " cannot be written (" + why.message() +
                                       "); check the permissions of the folder and the free space");
    };
    const Path partial = folder / (kPartial + std::to_string(getpid()));
    if (const auto error = createLike(partial, project)) return refuse(error);
    if (auto failure = fill(partial, project, request)) {
        removeDatabase(partial);
        return *std::move(failure);
    }
    ProjectBackup backup;
    backup.reason = request.reason;
    backup.made = request.now;
    backup.bytes = sizeOf(partial);
    constexpr auto kWrite = std::filesystem::perms::owner_write | std::filesystem::perms::group_write |
                            std::filesystem::perms::others_write;
    std::filesystem::permissions(partial, kWrite, std::filesystem::perm_options::remove, failed);
    if (const auto error = takeItsName(partial, backup, folder)) {
        removeDatabase(partial);
        return refuse(error);
    }
    dropOldest(project, request.spared);
    return {BackupOutcome::made, backup, {}};
}

/// The folder with its lock. Without the lock where the file system has none.
struct Place {
    FileLock::Attempt attempt;
    std::string notice;  ///< why there is no place
};

Place takePlace(const Path& project) {
    const Path folder = backupFolderOf(project);
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) {
        return {{},
                "no copy of the present state of " + project.string() + " was kept: the folder " + folder.string() +
                    " cannot be made (" + failed.message() + "); check the permissions of the folder"};
    }
    Place place{FileLock::tryTake(folder / "lock"), {}};
    // Whoever made those that lie there was killed: one who works holds the lock.
    if (place.attempt.outcome == FileLock::Outcome::taken) removePartials(folder);
    return place;
}

}  // namespace

Path backupFolderOf(const Path& project) {
    std::error_code failed;
    Path path = std::filesystem::weakly_canonical(project, failed);
    if (failed) path = std::filesystem::absolute(project, failed);
    return path.parent_path() / kBackupsFolder / path.filename();
}

std::vector<ProjectBackup> listBackups(const Path& project) {
    std::vector<ProjectBackup> backups;
    std::error_code failed;
    std::filesystem::directory_iterator entries(backupFolderOf(project), failed);
    for (; !failed && entries != std::filesystem::directory_iterator(); entries.increment(failed)) {
        auto backup = parseBackupName(entries->path());
        if (!backup) continue;
        backup->bytes = sizeOf(backup->path);
        backups.push_back(*std::move(backup));
    }
    // Names tell seconds; of two within one the file system knows which came later.
    const auto written = [](const ProjectBackup& backup) {
        std::error_code unknown;
        const auto time = std::filesystem::last_write_time(backup.path, unknown);
        return unknown ? std::filesystem::file_time_type::min() : time;
    };
    std::sort(backups.begin(), backups.end(), [&](const ProjectBackup& a, const ProjectBackup& b) {
        return a.made != b.made ? a.made > b.made : std::pair(written(a), a.path) > std::pair(written(b), b.path);
    });
    return backups;
}

BackupResult backUp(const Path& project, const BackupRequest& request) {
    const Place place = takePlace(project);
    if (!place.notice.empty()) return {BackupOutcome::impossible, std::nullopt, place.notice};
    if (place.attempt.outcome == FileLock::Outcome::held) {
        return {BackupOutcome::by_others, std::nullopt,
                place.attempt.words + " keeps a copy of " + project.string() + " at this moment; try again"};
    }
    return keep(project, request);
}

BackupResult backUpIfDue(const Path& project, const CopyWatch& watch, UtcTime now) {
    std::error_code missing;
    if (isBackup(project) || !std::filesystem::exists(project, missing) || !isDue(project, now)) return {};
    const Place place = takePlace(project);
    if (!place.notice.empty()) return {BackupOutcome::impossible, std::nullopt, place.notice};
    if (place.attempt.outcome == FileLock::Outcome::held) return {BackupOutcome::by_others, std::nullopt, {}};
    // Another program may have been quicker.
    return isDue(project, now) ? keep(project, {BackupReason::daily, watch, now, {}, nullptr}) : BackupResult{};
}

MigrationBackup backUpBeforeMigrating(const Path& project) {
    if (isBackup(project)) return {};
    const auto until = std::chrono::steady_clock::now() + kMigrationPatience;
    for (;;) {
        Place place = takePlace(project);
        if (!place.notice.empty()) return {{BackupOutcome::impossible, std::nullopt, place.notice}, nullptr};
        if (place.attempt.outcome == FileLock::Outcome::held && std::chrono::steady_clock::now() < until) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            continue;
        }
        MigrationBackup backup;
        backup.lock = std::move(place.attempt.lock);
        const int number = guarded(project, "opening", [&] {
            SQLite::Database database(project.string(), SQLite::OPEN_READWRITE, kBusyTimeoutMs);
            return schema::numberOf(database);
        });
        // Otherwise another program has brought it up to date meanwhile.
        if (number < schema::currentNumber()) {
            backup.result = keep(project, {BackupReason::before_migration, {}, utcNow(), {}, nullptr});
        }
        return backup;
    }
}

}  // namespace eyrie
