#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <system_error>

namespace SQLite {
class Database;
}

/// Copies of whole databases, and how they come into their place.
namespace eyrie {

/// Somebody who waits for a long copy.
struct CopyWatch {
    std::function<void(double share)> progress = {};  ///< may be empty; told 0 … 1 now and then, on the working thread
    std::stop_token stop = {};                        ///< ends the copy at its next step
};

/// Makes `target` what `source` is now: one state of it, whatever others commit meanwhile, and without keeping them
/// from doing so. All of `target` changes in one transaction or nothing. Answers false when stopped. Throws
/// SQLite::Exception.
bool copyDatabase(SQLite::Database& source, SQLite::Database& target, const CopyWatch& watch = {});

/// What was being written when a project was copied or damaged is being written no more. Throws SQLite::Exception.
void stopRunningRuns(SQLite::Database& database);

/// Makes a copy that nobody else has open a file of its own, which needs no other beside it; runs that were being
/// written are stopped in it. Of a damaged project not even that can be said: `tolerant` leaves it as it is then.
/// Throws SQLite::Exception.
void settleCopy(const std::filesystem::path& copy, bool tolerant);

/// An empty file that those may read who may read `like`. Fails when `path` is there already.
std::error_code createLike(const std::filesystem::path& path, const std::filesystem::path& like);

/// Renames a file unless the new name is taken: then std::errc::file_exists, and both files are left as they were.
std::error_code renameWithoutReplacing(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes a database and SQLite's companions of it.
void removeDatabase(const std::filesystem::path& path);

}  // namespace eyrie
