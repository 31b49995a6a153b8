#pragma once

#include <string>
#include <vector>

#include "store/project/project_file.h"

namespace eyrie {

/// What a comparison of methods over a sequence gave.
struct ComparisonRecord {
    int id = 0;
    std::string made_utc;  ///< ISO 8601
    std::string sequence;  ///< path of the video file or image folder
    std::string report;    ///< all figures, as the JSON that `compare --json` prints
};

/// Keeps a comparison in one transaction; id and time are set by the store. Throws Error(project).
int addComparison(ProjectFile& project, const std::string& sequence, const std::string& report);
/// Oldest first.
std::vector<ComparisonRecord> comparisons(ProjectFile& project);

}  // namespace eyrie
