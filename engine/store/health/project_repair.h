#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "store/backup/database_copy.h"

namespace eyrie {

/// What came of saving a damaged project. Lines are for people.
struct RepairReport {
    std::vector<std::string> saved;
    std::vector<std::string> lost;  ///< also what had to be assumed; empty when everything is there
    bool stopped = false;           ///< by the watch; then there is no new project
};

/// Saves all that can be read of a project into the new project `fresh`: table by table, around places that cannot be
/// read, without rows that are impossible. What rows belong to and is lost is made anew as far as the rows tell. The
/// damaged project is only read; nobody should write it meanwhile. Needs room for two copies of it beside `fresh`.
///
/// Throws Error(output) when `fresh` is there already, cannot be written or the disk is full, Error(project) when the
/// damaged one cannot be read at all.
RepairReport repairProject(const std::filesystem::path& damaged, const std::filesystem::path& fresh,
                           const CopyWatch& watch = {});

}  // namespace eyrie
