#pragma once

#include <filesystem>
#include <vector>

/// Looking at folders without exceptions of the standard library, whose messages help nobody.
namespace eyrie {

/// Whether a folder, or a regular file, is there; false also where that cannot be told (no permission, a link that
/// leads nowhere).
bool isFolder(const std::filesystem::path& path);
bool isFile(const std::filesystem::path& path);

/// Everything in a folder, in no order. Throws Error(input) naming the folder when it cannot be read.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder);

}  // namespace eyrie
