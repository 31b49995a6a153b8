#pragma once

#include <filesystem>

#include "store/project_file.h"

namespace eyrie::ui {

/// Writes a complete copy of a project, replacing `target` only once it is whole. Works while a run writes into the
/// project. Throws Error(output).
void copyProject(ProjectFile& project, const std::filesystem::path& target);

}  // namespace eyrie::ui
