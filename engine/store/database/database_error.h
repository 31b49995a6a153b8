#pragma once

#include <SQLiteCpp/Exception.h>

#include <filesystem>
#include <string>

#include "core/error.h"

namespace eyrie {

/// Turns what SQLite reports into an Error that names the file, what was being done ("reading frame 12 of run 1") and
/// the remedy.
Error databaseError(const std::filesystem::path& path, const std::string& doing, const SQLite::Exception& exception);

/// An Error(project) for a file whose contents contradict themselves.
Error damagedProject(const std::filesystem::path& path, const std::string& what);

/// Thrown while reading a row that no writer wrote; guarded() makes it an Error(project).
struct MalformedRow {
    std::string what;
};

/// Runs `work` and turns SQLite's exceptions and malformed rows into Errors.
template <class Work>
auto guarded(const std::filesystem::path& path, const std::string& doing, Work&& work) {
    try {
        return work();
    } catch (const SQLite::Exception& exception) {
        throw databaseError(path, doing, exception);
    } catch (const MalformedRow& row) {
        throw damagedProject(path, doing + ": " + row.what);
    }
}

}  // namespace eyrie
