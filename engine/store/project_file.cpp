#include "store/project_file.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>
#include <unistd.h>

#include <string>

#include "core/error.h"
#include "store/database_error.h"
#include "store/file_check.h"
#include "store/schema.h"

namespace eyrie {
namespace {

using Path = std::filesystem::path;

constexpr int kBusyTimeoutMs = 5000;
// A frame's arrays are 100 kB and more; small pages would chain dozens of them.
constexpr int kPageSize = 8192;

/// `path` as URI that SQLite opens without locks and without its log, for folders that cannot be written.
std::string immutableUri(const Path& path) {
    std::string uri = "file:";
    for (const char c : path.string()) {
        if (c == '%' || c == '?' || c == '#') {
            constexpr char kHex[] = "0123456789abcdef";
            uri += '%';
            uri += kHex[static_cast<unsigned char>(c) >> 4];
            uri += kHex[static_cast<unsigned char>(c) & 15];
        } else {
            uri += c;
        }
    }
    return uri + "?immutable=1";
}

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
    return access(path.c_str(), W_OK) == 0 && access(path.parent_path().c_str(), W_OK) == 0;
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
}

/// Writes an empty project of the newest schema.
void build(const Path& path) {
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kBusyTimeoutMs);
    database.exec("PRAGMA page_size = " + std::to_string(kPageSize));
    database.exec("PRAGMA application_id = " + std::to_string(schema::kApplicationId));
    schema::migrate(database, schema::migrations());
    makeDurable(database);
}

void removeWithCompanions(const Path& path) {
    std::error_code ignored;
    for (const char* ending : {"", "-journal", "-wal", "-shm"}) {
        std::filesystem::remove(path.string() + ending, ignored);
    }
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
    if (std::filesystem::exists(absolute, failed)) {
        throw Error(ErrorKind::output, absolute.string() + " exists already; open it, or choose another name");
    }
    if (!std::filesystem::is_directory(absolute.parent_path(), failed)) {
        throw Error(ErrorKind::output, "the folder " + absolute.parent_path().string() + " for the project " +
                                           absolute.filename().string() + " does not exist; make it first");
    }
    // Built aside and renamed, so that a project is there whole or not at all.
    const Path aside = absolute.string() + ".new-" + std::to_string(getpid());
    removeWithCompanions(aside);
    try {
        build(aside);
        std::filesystem::rename(aside, absolute);
    } catch (const SQLite::Exception& exception) {
        removeWithCompanions(aside);
        throw Error(ErrorKind::output, "the project " + absolute.string() + " cannot be made (" + exception.what() +
                                           "); check that its folder may be written and that the disk has space");
    } catch (const std::filesystem::filesystem_error& error) {
        removeWithCompanions(aside);
        throw Error(ErrorKind::output, "the project " + absolute.string() + " cannot be made (" +
                                           error.code().message() + "); check that its folder may be written");
    }
    return open(absolute);
}

ProjectFile ProjectFile::open(const std::filesystem::path& path, Mode mode) {
    std::error_code failed;
    const Path absolute = std::filesystem::absolute(path, failed);
    checkFile(absolute);
    return guarded(absolute, "opening", [&] {
        std::unique_ptr<SQLite::Database> database;
        if (mode == Mode::read_only) {
            database = openForReading(absolute);
        } else {
            database = std::make_unique<SQLite::Database>(absolute.string(), SQLite::OPEN_READWRITE, kBusyTimeoutMs);
        }
        database->exec("PRAGMA foreign_keys = ON");
        database->exec("PRAGMA trusted_schema = OFF");
        database->exec("PRAGMA cell_size_check = ON");
        refuseForeign(absolute, *database);
        if (mode == Mode::read_write) {
            // SQLite opens a write-protected file for reading without a word.
            if (sqlite3_db_readonly(database->getHandle(), "main") == 1) {
                throw Error(ErrorKind::output,
                            "the project " + absolute.string() + " is write-protected; change that or copy it");
            }
            makeDurable(*database);
            schema::migrate(*database, schema::migrations());
        } else if (schema::numberOf(*database) < schema::currentNumber()) {
            if (!mayWrite(absolute)) {
                throw Error(ErrorKind::project, "the project " + absolute.string() +
                                                    " is of an older version and must be brought up to date; open it "
                                                    "once where it can be written");
            }
            database.reset();
            open(absolute, Mode::read_write);  // brings it up to date
            return open(absolute, mode);
        }
        // Reads the whole schema, which tells a damaged one now and not in the middle of the work.
        if (!database->tableExists("run")) throw damagedProject(absolute, "it has no table of runs");
        return ProjectFile(absolute, mode, std::move(database));
    });
}

ProjectFile ProjectFile::openOrCreate(const std::filesystem::path& path) {
    std::error_code failed;
    return std::filesystem::exists(path, failed) ? open(path) : create(path);
}

}  // namespace eyrie
