#include "core/project_name.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace eyrie {

bool hasProjectName(const std::filesystem::path& path) {
    const std::string_view wanted = kProjectEnding;
    const std::string ending = path.extension().string();
    return std::equal(ending.begin(), ending.end(), wanted.begin(), wanted.end(),
                      [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

}  // namespace eyrie
