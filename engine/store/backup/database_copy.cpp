#include "store/backup/database_copy.h"

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <optional>
#include <string>
#include <thread>

namespace eyrie {
namespace {

constexpr int kPagesAStep = 256;  // 2 MB
constexpr auto kPause = std::chrono::milliseconds(20);
constexpr auto kPatience = std::chrono::seconds(5);
constexpr int kRestarts = 5;

}  // namespace

bool copyDatabase(SQLite::Database& source, SQLite::Database& target, const CopyWatch& watch) {
    std::optional<SQLite::Transaction> moment;
    const auto hold = [&] {
        moment.emplace(source);
        source.execAndGet("PRAGMA user_version");
    };
    // With a log beside it, one who reads keeps nobody from writing, so the state of this moment is held. Without, who
    // reads keeps writers waiting: there SQLite begins again after every change, and only at last is the state held.
    if (source.execAndGet("PRAGMA journal_mode").getString() == "wal") hold();

    SQLite::Backup backup(target, source);
    auto patience = std::chrono::steady_clock::now() + kPatience;
    int left = 0;
    int restarts = 0;
    while (!watch.stop.stop_requested()) {
        const int result = backup.executeStep(kPagesAStep);
        if (result == SQLITE_BUSY || result == SQLITE_LOCKED) {
            if (std::chrono::steady_clock::now() > patience) throw SQLite::Exception("database is locked", result);
            std::this_thread::sleep_for(kPause);
            continue;
        }
        patience = std::chrono::steady_clock::now() + kPatience;
        if (left > 0 && backup.getRemainingPageCount() > left && ++restarts == kRestarts && !moment) hold();
        left = backup.getRemainingPageCount();
        if (watch.progress && backup.getTotalPageCount() > 0) {
            watch.progress(1 - static_cast<double>(left) / backup.getTotalPageCount());
        }
        if (result == SQLITE_DONE) return true;
    }
    return false;
}

void stopRunningRuns(SQLite::Database& database) {
    database.exec("UPDATE run SET state = 'stopped' WHERE state = 'running'");
}

void settleCopy(const std::filesystem::path& copy, bool tolerant) {
    SQLite::Database database(copy.string(), SQLite::OPEN_READWRITE);
    try {
        database.exec("PRAGMA journal_mode = DELETE");
        stopRunningRuns(database);
    } catch (const SQLite::Exception&) {
        if (!tolerant) throw;
    }
}

std::error_code createLike(const std::filesystem::path& path, const std::filesystem::path& like) {
    struct stat facts {};
    const mode_t mode = stat(like.c_str(), &facts) == 0 ? facts.st_mode & 0666 : 0666;
    const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode | 0600);
    if (descriptor < 0) return {errno, std::generic_category()};
    close(descriptor);
    return {};
}

std::error_code renameWithoutReplacing(const std::filesystem::path& from, const std::filesystem::path& to) {
    if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return {};
    if (errno != EINVAL && errno != ENOSYS) return {errno, std::generic_category()};
    // A file system that cannot do both at once: a second name, and then the first goes.
    if (link(from.c_str(), to.c_str()) != 0) return {errno, std::generic_category()};
    unlink(from.c_str());
    return {};
}

void removeDatabase(const std::filesystem::path& path) {
    std::error_code ignored;
    for (const char* ending : {"", "-journal", "-wal", "-shm"}) {
        std::filesystem::remove(path.string() + ending, ignored);
    }
}

}  // namespace eyrie
