#pragma once

#include <SQLiteCpp/Database.h>
#include <sqlite3.h>

#include <stop_token>
#include <utility>

namespace eyrie {

/// While it lives, a request to stop ends the statement that runs on a connection: it throws SQLite::Exception with
/// SQLITE_INTERRUPT.
class StopHandler {
 public:
    StopHandler(SQLite::Database& database, std::stop_token stop) : database_(database), stop_(std::move(stop)) {
        constexpr int kInstructions = 10'000;
        sqlite3_progress_handler(database_.getHandle(), kInstructions, asked, &stop_);
    }
    ~StopHandler() { sqlite3_progress_handler(database_.getHandle(), 0, nullptr, nullptr); }
    StopHandler(const StopHandler&) = delete;
    StopHandler& operator=(const StopHandler&) = delete;

 private:
    static int asked(void* stop) { return static_cast<std::stop_token*>(stop)->stop_requested() ? 1 : 0; }
    SQLite::Database& database_;
    std::stop_token stop_;
};

}  // namespace eyrie
