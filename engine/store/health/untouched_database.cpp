#include "store/health/untouched_database.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>
#include <unistd.h>

#include "store/backup/backup_name.h"
#include "store/database/busy_timeout.h"
#include "store/database/database_uri.h"
#include "store/health/file_check.h"

namespace eyrie {
namespace {

std::unique_ptr<SQLite::Database> careful(std::unique_ptr<SQLite::Database> database) {
    database->exec("PRAGMA query_only = ON");
    database->exec("PRAGMA trusted_schema = OFF");
    database->exec("PRAGMA cell_size_check = ON");
    return database;
}

}  // namespace

std::unique_ptr<SQLite::Database> openWithoutLog(const std::filesystem::path& path) {
    return careful(std::make_unique<SQLite::Database>(immutableUri(path), SQLite::OPEN_READONLY | SQLite::OPEN_URI));
}

std::unique_ptr<SQLite::Database> openUntouched(const std::filesystem::path& path) {
    const bool may_write =
        access(path.c_str(), W_OK) == 0 && access(std::filesystem::absolute(path).parent_path().c_str(), W_OK) == 0;
    if (isBackup(path) || (!may_write && !hasLog(path))) return openWithoutLog(path);
    // SQLite's companions go with the last connection that could write; one that could not would leave them behind.
    auto database = std::make_unique<SQLite::Database>(
        path.string(), may_write ? SQLite::OPEN_READWRITE : SQLite::OPEN_READONLY, kBusyTimeoutMs);
    if (hasLog(path)) sqlite3_db_config(database->getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    return careful(std::move(database));
}

}  // namespace eyrie
