#pragma once

#include <cstdint>
#include <stop_token>
#include <string>

namespace SQLite {
class Database;
}

namespace eyrie {

/// What came of a table.
struct TableRescue {
    std::int64_t rows = 0;  ///< saved
    bool whole = true;      ///< read to its end without an error
    std::string fault;      ///< the first error, as SQLite words it
};

/// Copies the rows of a table from the database attached as "damaged" into the table of the same name in the main one,
/// as many as can be read: where reading fails, the rows before and behind that place. Columns that the damaged one
/// does not have get their defaults. Throws SQLite::Exception only with SQLITE_INTERRUPT, SQLITE_FULL and failures to
/// write.
TableRescue rescueTable(SQLite::Database& database, const std::string& table);

}  // namespace eyrie
