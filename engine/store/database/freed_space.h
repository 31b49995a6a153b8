#pragma once

#include <chrono>

namespace SQLite {
class Database;
}

namespace eyrie {

/// Gives what was deleted back to the disk, where the project was made to do so (projects of schema 15 on); elsewhere
/// the space is used again by what comes next. Works in steps of some hundredths of a second, between which others may
/// write, and ends after `most`, in which at least one step is done: what is left then is used again, or given back the
/// next time. Does nothing more once others keep it from working.
void giveBackSpace(SQLite::Database& database, std::chrono::milliseconds most = std::chrono::minutes(5));

}  // namespace eyrie
