#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace eyrie {

/// Replaces a file in one step: readers see the old bytes or the new ones, never a part. Throws Error(output) naming
/// the file and the reason; the old file is untouched then.
void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes);

/// All bytes of a file. Throws Error(input) when it is missing, a folder or cannot be read.
std::string readWholeFile(const std::filesystem::path& path);

}  // namespace eyrie
