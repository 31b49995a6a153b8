#include "store/project/project_file.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>
#include <unistd.h>

#include <string>

#include "core/error.h"
#include "store/backup/backup_name.h"
#include "store/backup/project_backup.h"
#include "store/database/busy_timeout.h"
#include "store/database/database_error.h"
#include "store/database/database_uri.h"
#include "store/database/new_file.h"
#include "store/database/new_place.h"
#include "store/health/file_check.h"
#include "store/project/schema.h"

namespace eyrie {
namespace {

using Path = std::filesystem::path;

// A frame's arrays are 100 kB and more; small pages would chain dozens of them.
constexpr int kPageSize = 8192;

std::unique_ptr<SQLite::Database> openReadOnly(const Path& path) {
    auto database = std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READONLY, kBusyTimeoutMs);
    try {
        schema::numberOf(*database);
    } catch (const SQLite::Exception& exception) {
        // A log-keeping database needs files beside it; on a read-only medium it can do without if the log is empty.
        if (exception.getErrorCode() != SQLITE_CANTOPEN || hasLog(path)) throw;
        database = std::make_unique<SQLite::Database>(immutableUri(path), SQLite::OPEN_READONLY | SQLite::OPEN_URI);
    }
    return database;
}

bool mayWrite(const Path& path) {
    return !isBackup(path) && access(path.c_str(), W_OK) == 0 && access(path.parent_path().c_str(), W_OK) == 0;
}

/// A connection for reading that tidies up: SQLite's companions of a log-keeping database go with the last connection
/// that could write; one that could not leaves them.
std::unique_ptr<SQLite::Database> openForReading(const Path& path) {
    auto database = openReadOnly(path);
    const bool ours = database->execAndGet("PRAGMA application_id").getInt() == schema::kApplicationId;
    if (!ours || !mayWrite(path)) return database;
    database = std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READWRITE, kBusyTimeoutMs);
    database->exec("PRAGMA query_only = ON");
    return database;
}

void refuseForeign(const Path& path, SQLite::Database& database) {
    const int application = database.execAndGet("PRAGMA application_id").getInt();
    if (application != schema::kApplicationId) {
        throw Error(ErrorKind::project, path.string() +
                                            " is a database of another program, not an Eyrie project; it was left "
                                            "untouched; choose another file");
    }
    const int number = schema::numberOf(database);
    if (number > schema::currentNumber()) {
        throw Error(ErrorKind::project, "the project " + path.string() +
                                            " was written by a newer version of Eyrie (schema " +
                                            std::to_string(number) + ", this version knows " +
                                            std::to_string(schema::currentNumber()) + "); install that version");
    }
    if (number < 1) throw damagedProject(path, "schema number " + std::to_string(number));
}

/// A killed process loses nothing that was committed; after a crash of the system the file is whole, and at most the
/// last commits since the log was last synchronised are missing.
void makeDurable(SQLite::Database& database) {
    const std::string mode = database.execAndGet("PRAGMA journal_mode = WAL").getString();
    // Some network drives cannot keep a log; the older journal is safe only when synchronised fully.
    database.exec(mode == "wal" ? "PRAGMA synchronous = NORMAL" : "PRAGMA synchronous = FULL");
    database.exec("PRAGMA journal_size_limit = 67108864");
    // Debian's SQLite writes zeros over all that is deleted: hundreds of megabytes when a long run is finished.
    database.exec("PRAGMA secure_delete = OFF");
}

/// What the file holds must not act: no triggers, no views, no functions from its own definitions.
void distrust(SQLite::Database& database) {
    sqlite3* handle = database.getHandle();
    sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, static_cast<int>(ProjectFile::kLongestRow));
    database.exec("PRAGMA cell_size_check = ON");
}

/// The bytes of an empty project of the newest schema that keeps a log.
std::string emptyProject() {
    SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    database.exec("PRAGMA page_size = " + std::to_string(kPageSize));
    database.exec("PRAGMA auto_vacuum = INCREMENTAL");  // what a finished run puts away is given back to the disk
    database.exec("PRAGMA application_id = " + std::to_string(schema::kApplicationId));
    schema::migrate(database, schema::migrations());
    sqlite3_int64 size = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> bytes(
        sqlite3_serialize(database.getHandle(), "main", &size, 0), sqlite3_free);
    if (!bytes) throw SQLite::Exception(database.getHandle());
    std::string file(reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size));
    // "Database File Format", §1.3.3: versions 2 of both formats stand for a write-ahead log.
    file.at(18) = 2;
    file.at(19) = 2;
    return file;
}

/// Answers whether it was made; false when it is there.
bool make(const Path& path) {
    std::error_code failed;
    if (!std::filesystem::is_directory(path.parent_path(), failed)) {
        throw Error(ErrorKind::output, "the folder " + path.parent_path().string() + " for the project " +
                                           path.filename().string() + " does not exist; make it first");
    }
    const NewPlace place(path);
    if (!place.isFree()) return false;
    return guarded(path, "making it", [&] { return makeNewFile(path, emptyProject()); });
}

}  // namespace

ProjectFile::ProjectFile(std::filesystem::path path, Mode mode, std::unique_ptr<SQLite::Database> database)
    : path_(std::move(path)), mode_(mode), database_(std::move(database)) {}
ProjectFile::ProjectFile(ProjectFile&&) noexcept = default;
ProjectFile& ProjectFile::operator=(ProjectFile&&) noexcept = default;
ProjectFile::~ProjectFile() = default;

ProjectFile ProjectFile::create(const std::filesystem::path& path) {
    std::error_code failed;
    const Path absolute = std::filesystem::absolute(path, failed);
    if (std::filesystem::exists(std::filesystem::symlink_status(absolute, failed)) || !make(absolute)) {
        throw Error(ErrorKind::output, absolute.string() + " exists already; open it, or choose another name");
    }
    return open(absolute);
}

ProjectFile ProjectFile::open(const std::filesystem::path& path, Mode mode) {
    std::error_code failed;
    const Path absolute = std::filesystem::absolute(path, failed);
    checkFile(absolute);
    return guarded(absolute, "opening", [&] {
        std::unique_ptr<SQLite::Database> database;
        std::string notice;
        if (mode == Mode::read_write && isBackup(absolute)) {
            throw Error(ErrorKind::output,
                        absolute.string() + " is a kept earlier state of a project; restore it with eyrie-cli restore");
        }
        if (mode == Mode::read_only) {
            database = openForReading(absolute);
        } else {
            database = std::make_unique<SQLite::Database>(absolute.string(), SQLite::OPEN_READWRITE, kBusyTimeoutMs);
        }
        distrust(*database);
        database->exec("PRAGMA foreign_keys = ON");
        refuseForeign(absolute, *database);
        if (mode == Mode::read_write) {
            // SQLite opens a write-protected file for reading without a word.
            if (sqlite3_db_readonly(database->getHandle(), "main") == 1) {
                throw Error(ErrorKind::output,
                            "the project " + absolute.string() + " is write-protected; change that or copy it");
            }
            makeDurable(*database);
            if (schema::numberOf(*database) < schema::currentNumber()) {
                // Migrating is a transaction, so that a copy that cannot be made is told but keeps nobody out.
                const MigrationBackup kept = backUpBeforeMigrating(absolute);
                notice = kept.result.notice;
                schema::migrate(*database, schema::migrations());
            }
        } else if (schema::numberOf(*database) < schema::currentNumber()) {
            if (!mayWrite(absolute)) {
                throw Error(ErrorKind::project, "the project " + absolute.string() +
                                                    " is of an older version and must be brought up to date; open it "
                                                    "once where it can be written");
            }
            database.reset();
            const std::string told = open(absolute, Mode::read_write).notice();  // brings it up to date
            ProjectFile project = open(absolute, mode);
            project.notice_ = told;
            return project;
        }
        // Tells a damaged schema now and not in the middle of the work.
        schema::checkTables(*database);
        ProjectFile project(absolute, mode, std::move(database));
        project.notice_ = notice;
        return project;
    });
}

ProjectFile ProjectFile::openOrCreate(const std::filesystem::path& path) {
    std::error_code failed;
    const Path absolute = std::filesystem::absolute(path, failed);
    if (!std::filesystem::exists(absolute, failed)) make(absolute);  // or another program just did
    return open(absolute);
}

void ProjectFile::checkInPlace() const {
    int moved = 0;
    if (sqlite3_file_control(database_->getHandle(), "main", SQLITE_FCNTL_HAS_MOVED, &moved) != SQLITE_OK || !moved)
        return;
    throw Error(ErrorKind::project, "the project " + path_.string() +
                                        " was deleted, moved or replaced while it was open; nothing more can be stored "
                                        "in it. Put it back in its place, or save a copy of what is open");
}

}  // namespace eyrie
