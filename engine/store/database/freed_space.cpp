#include "store/database/freed_space.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <algorithm>
#include <string>
#include <thread>
#include <utility>

namespace eyrie {
namespace {

using Clock = std::chrono::steady_clock;

// A connection that waits for its turn asks every tenth of a second and gives up after some seconds (busy_timeout.h):
// steps are short, and the pauses a good part of the time.
constexpr auto kLongestStep = std::chrono::milliseconds(30);
constexpr auto kPauseBetween = std::chrono::milliseconds(15);
constexpr int kFewestPages = 16;
constexpr int kFirstPages = 64;
constexpr int kMostPagesAtOnce = 4096;

int freePages(SQLite::Database& database) {
    return database.execAndGet("PRAGMA freelist_count").getInt();
}

}  // namespace

void giveBackSpace(SQLite::Database& database, std::chrono::milliseconds most) {
    const auto until = Clock::now() + most;
    int pages = kFirstPages;
    try {
        int left = freePages(database);
        while (left > 0) {
            SQLite::Transaction step(database, SQLite::TransactionBehavior::IMMEDIATE);
            // Only from here on does it keep others waiting; how long it waited for its own turn says nothing about a
            // step.
            const auto begun = Clock::now();
            if (database.tryExec("PRAGMA incremental_vacuum(" + std::to_string(pages) + ")") != SQLITE_OK) return;
            step.commit();
            const auto took = Clock::now() - begun;
            const int former = std::exchange(left, freePages(database));
            if (left == 0 || left >= former || Clock::now() >= until) return;
            if (took > kLongestStep) pages = std::max(kFewestPages, pages / 2);
            if (took < kLongestStep / 2) pages = std::min(kMostPagesAtOnce, pages * 2);
            std::this_thread::sleep_for(kPauseBetween);
        }
    } catch (const SQLite::Exception&) {
        // The file is as good as before, only larger.
    }
}

}  // namespace eyrie
