#pragma once

#include <filesystem>
#include <string>

namespace eyrie {

/// `path` as URI that SQLite opens without locks and without its log (SQLite::OPEN_URI): for files that nobody writes,
/// such as backups, and for folders that cannot be written.
std::string immutableUri(const std::filesystem::path& path);

}  // namespace eyrie
