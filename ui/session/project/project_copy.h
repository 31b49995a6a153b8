#pragma once

#include <filesystem>

#include "store/project/project_file.h"

namespace eyrie::ui {

/// Writes a complete copy of a project, there only once it is whole. Works while a run writes into the project. Throws
/// Error(output), also when there is a file of that name: a project is never replaced.
void copyProject(ProjectFile& project, const std::filesystem::path& target);

}  // namespace eyrie::ui
