#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "store/backup/database_copy.h"

namespace eyrie {

/// How bad a finding of a check is.
enum class Health {
    good,
    remark,  ///< nothing is wrong, but one should know
    damaged
};

/// What was found in one respect.
struct HealthItem {
    std::string subject;  ///< "structure", "runs", …
    Health health = Health::good;
    std::string words;  ///< for people
};

/// What a check of a project found.
struct HealthReport {
    std::vector<HealthItem> items;
    bool stopped = false;  ///< by the watch; the items are those until then
    bool healthy() const;
};

/// Looks at everything in a project, of any schema up to this version's, and at what lies beside it; changes nothing.
/// Reads the whole file, which takes seconds for large ones; others may work on it meanwhile. Throws Error(project)
/// when there is no file to look at, or it is a database of another program or of a newer version.
HealthReport checkProject(const std::filesystem::path& path, const CopyWatch& watch = {});

}  // namespace eyrie
