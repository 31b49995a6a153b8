#include "store/backup/project_restore.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>
#include <unistd.h>

#include <string>

#include "store/database/database_error.h"
#include "store/database/database_uri.h"
#include "store/database/new_place.h"
#include "store/journal/writer_lock.h"

namespace eyrie {
namespace {

using Path = std::filesystem::path;

/// The kept state, checked to be one.
SQLite::Database openBackup(const ProjectBackup& backup) {
    return guarded(backup.path, "opening the kept state", [&] {
        SQLite::Database source(immutableUri(backup.path), SQLite::OPEN_READONLY | SQLite::OPEN_URI);
        if (!source.tableExists("run")) throw damagedProject(backup.path, "it has no table of runs");
        return source;
    });
}

/// Who labels or reviews the project, where that can be told.
std::string holderOf(const Path& project) {
    const auto holder = WriterLock::holderOf(project);
    return holder ? " (" + *holder + ")" : "";
}

/// Makes the connection the only one. Every other connection to a project keeps a shared lock as long as it is open,
/// since the project keeps a log; leaving that mode needs all locks.
void takeAlone(const Path& project, SQLite::Database& database) {
    try {
        database.exec("PRAGMA locking_mode = EXCLUSIVE");
        if (database.execAndGet("PRAGMA journal_mode = DELETE").getString() != "delete") {
            throw SQLite::Exception("database is locked", SQLITE_BUSY);
        }
        database.exec("BEGIN EXCLUSIVE");
        database.exec("COMMIT");  // the lock stays
    } catch (const SQLite::Exception& exception) {
        if (exception.getErrorCode() == SQLITE_BUSY || exception.getErrorCode() == SQLITE_LOCKED) {
            throw Error(ErrorKind::project, "the project " + project.string() +
                                                " is open in another program or window" + holderOf(project) +
                                                "; close it there and restore again");
        }
        if (exception.getErrorCode() == SQLITE_CORRUPT || exception.getErrorCode() == SQLITE_NOTADB) {
            throw Error(ErrorKind::project, "the project " + project.string() +
                                                " is too damaged to keep its present state (" + exception.what() +
                                                "); restore into a new file, or move it away and restore again");
        }
        throw databaseError(project, "restoring", exception);
    }
}

}  // namespace

BackupResult restoreBackup(const Path& project, const ProjectBackup& backup, const CopyWatch& watch) {
    std::error_code missing;
    if (!std::filesystem::exists(project, missing)) {
        const bool whole = restoreAsNew(backup, project, watch);
        return {whole ? BackupOutcome::not_due : BackupOutcome::stopped, std::nullopt, {}};
    }
    SQLite::Database source = openBackup(backup);
    return guarded(project, "restoring", [&]() -> BackupResult {
        SQLite::Database target(project.string(), SQLite::OPEN_READWRITE);
        takeAlone(project, target);
        BackupRequest request;
        request.watch.stop = watch.stop;
        request.spared = backup.path;
        request.connection = &target;
        BackupResult kept = backUp(project, request);
        if (kept.outcome == BackupOutcome::impossible) {
            throw Error(ErrorKind::project, kept.notice + "; nothing was restored");
        }
        if (kept.outcome == BackupOutcome::made && !copyDatabase(source, target, watch)) {
            kept.outcome = BackupOutcome::stopped;
        }
        return kept;
    });
}

bool restoreAsNew(const ProjectBackup& backup, const Path& fresh, const CopyWatch& watch) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ErrorKind::output, "the project " + fresh.string() + " cannot be made: " + why);
    };
    std::error_code failed;
    if (std::filesystem::exists(fresh, failed)) refuse("there is a file of that name; choose another");
    SQLite::Database source = openBackup(backup);
    const Path aside = lockFileBeside(fresh, ".new-" + std::to_string(getpid()));
    removeDatabase(aside);
    if (const auto error = createLike(aside, backup.path)) {
        refuse(error.message() + "; check that its folder exists and may be written");
    }
    try {
        SQLite::Database target(aside.string(), SQLite::OPEN_READWRITE);
        if (!copyDatabase(source, target, watch)) {
            removeDatabase(aside);
            return false;
        }
    } catch (const SQLite::Exception& exception) {
        removeDatabase(aside);
        throw databaseError(fresh, "restoring", exception);
    }
    const NewPlace place(fresh);
    if (const auto error = renameWithoutReplacing(aside, fresh)) {
        removeDatabase(aside);
        refuse(error.message() + "; choose another name or folder");
    }
    return true;
}

}  // namespace eyrie
