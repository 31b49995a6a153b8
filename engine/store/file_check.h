#pragma once

#include <filesystem>

namespace eyrie {

/// Looks at the bytes of a project file before SQLite does, for messages that help: Error(project) when it is missing,
/// cannot be read, is empty, no database, or shorter than its header says.
void checkFile(const std::filesystem::path& path);

/// Whether committed pages wait in a log beside the project to be moved into it (a process was killed, or works now).
bool hasLog(const std::filesystem::path& project);

}  // namespace eyrie
