#pragma once

#include <filesystem>

namespace eyrie {

/// How the name of a project file ends.
inline constexpr char kProjectEnding[] = ".eyrie";

/// Whether the name is that of a project, in small letters or capitals. Such a file is never opened to find out what it
/// is: closing it again would drop the locks of this process's connections (store/health/file_check.h).
bool hasProjectName(const std::filesystem::path& path);

}  // namespace eyrie
