#include "core/project_name.h"

#include "core/text.h"

namespace eyrie {

bool hasProjectName(const std::filesystem::path& path) {
    return hasEnding(path, kProjectEnding);
}

}  // namespace eyrie
