#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "store/backup/database_copy.h"

namespace eyrie {

/// A copy of a damaged project in which as much as possible can be read; the project itself is only read.
struct DamagedCopy {
    std::filesystem::path path;
    std::vector<std::string> notes;  ///< for people: what had to be assumed
    bool stopped = false;            ///< by the watch
};

/// Makes one in an empty folder. A header that cannot be is replaced by that of every project; where the list of tables
/// is lost, the file is taken for one that this version made. A log that contradicts the file is left out. Throws
/// Error(project) when the file cannot be read, Error(output) when the copy cannot be written.
DamagedCopy copyDamaged(const std::filesystem::path& project, const std::filesystem::path& folder,
                        const CopyWatch& watch);

}  // namespace eyrie
