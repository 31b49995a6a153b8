#include "store/journal/number_counter.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <limits>
#include <string>

namespace eyrie {
namespace {

/// Damage may have left any number; some must be left to count on from there.
constexpr std::int64_t kLastStart = std::numeric_limits<int>::max() - 1'000'000;

}  // namespace

std::int64_t readCounter(SQLite::Database& database, const char* kind) {
    SQLite::Statement statement(database, "SELECT value FROM label_counter WHERE kind = ?");
    statement.bind(1, kind);
    return statement.executeStep() ? statement.getColumn(0).getInt64() : 0;
}

void raiseCounter(SQLite::Database& database, const char* kind, std::int64_t value) {
    SQLite::Statement statement(database,
                                "INSERT INTO label_counter (kind, value) VALUES (?, ?) ON CONFLICT (kind) DO UPDATE "
                                "SET value = max(value, excluded.value)");
    statement.bind(1, kind);
    statement.bind(2, value);
    statement.exec();
}

void NumberCounter::read(SQLite::Database& database) {
    const std::string most = std::string("SELECT coalesce(max(id), 0) FROM ") + table_.table;
    const std::int64_t next =
        std::max(readCounter(database, table_.counter), std::min(database.execAndGet(most).getInt64(), kLastStart) + 1);
    next_ = static_cast<int>(std::clamp<std::int64_t>(next, 1, kLastStart));
}

void NumberCounter::follow(int id) {
    if (id < std::numeric_limits<int>::max()) next_ = std::max(next_, id + 1);
}

}  // namespace eyrie
