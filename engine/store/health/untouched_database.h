#pragma once

#include <filesystem>
#include <memory>

namespace SQLite {
class Database;
}

namespace eyrie {

/// A connection for looking at a file in whatever state it is: neither the file nor the log beside it is changed,
/// nothing new stays beside it, nothing in it is trusted or migrated. Only a change that was killed half done is rolled
/// back, as SQLite must before anything can be read. Throws SQLite::Exception, perhaps only with the first statement.
std::unique_ptr<SQLite::Database> openUntouched(const std::filesystem::path& path);

/// The same as the file is without the log beside it.
std::unique_ptr<SQLite::Database> openWithoutLog(const std::filesystem::path& path);

}  // namespace eyrie
