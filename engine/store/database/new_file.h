#pragma once

#include <filesystem>
#include <string_view>

namespace eyrie {

/// Makes a file that is there whole or not at all, and never replaces one. Answers whether it was made; false when
/// something of that name is there, whoever was quicker. A killed process leaves nothing behind where the file system
/// knows files without a name. Throws Error(output) naming the file and the reason.
bool makeNewFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace eyrie
