#pragma once

#include <cstdint>

namespace SQLite {
class Database;
}

/// Counters of a project. All throw SQLite::Exception; the caller guards and, when writing, owns the transaction.
namespace eyrie {

/// 0 when never set.
std::int64_t readCounter(SQLite::Database& database, const char* kind);
/// Sets a counter unless it is higher already.
void raiseCounter(SQLite::Database& database, const char* kind, std::int64_t value);

/// Rows that are numbered over the whole project, each number once, also after its row is gone.
struct NumberedTable {
    const char* counter;  ///< "object"
    const char* table;    ///< "labelled_object", with the column id
};

/// Hands the numbers out.
class NumberCounter {
 public:
    explicit NumberCounter(NumberedTable table) : table_(table) {}

    /// From the project; also where the counter is damaged or lost, it is behind every number that is there.
    void read(SQLite::Database& database);
    int take() { return next_++; }
    /// What take() would give.
    int next() const { return next_; }
    /// `id` was used.
    void follow(int id);
    void store(SQLite::Database& database) const { raiseCounter(database, table_.counter, next_); }

 private:
    NumberedTable table_;
    int next_ = 1;
};

}  // namespace eyrie
