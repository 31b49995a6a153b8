#pragma once

#include <filesystem>

namespace eyrie {

/// Nothing but SQLite may open a project's file: POSIX drops all locks that a process holds on a file as soon as it
/// closes any descriptor of it, and the next program would believe to be alone. What is read here goes through SQLite's
/// own file layer, which knows the process's open connections.

/// Looks at the bytes of a project file before it is opened, for messages that help: Error(project) when it is missing,
/// cannot be read, is empty, no database, or shorter than its header says.
void checkFile(const std::filesystem::path& path);

/// Whether a file is to be opened as a project: by its ending (.eyrie), also of one that is missing, or its first
/// bytes.
bool isProject(const std::filesystem::path& path);

/// Whether committed pages wait in a log beside the project to be moved into it (a process was killed, or works now).
bool hasLog(const std::filesystem::path& project);

}  // namespace eyrie
