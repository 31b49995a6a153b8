#pragma once

#include <string>

#include "store/project/project_file.h"

namespace eyrie {

/// How the files of its video lay there when a run began, as listingDigestOf() tells it (io/file_digest.h). Empty where
/// it is not known: runs of before schema 27, live ones. Throws Error(project).
std::string sourceDigestOf(ProjectFile& project, int run_id);
void storeSourceDigest(ProjectFile& project, int run_id, const std::string& digest);

}  // namespace eyrie
