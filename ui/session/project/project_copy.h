#pragma once

#include <filesystem>

#include "store/project/project_file.h"

namespace eyrie::ui {

/// What becomes of steps of labelling and reviewing that are done while a project is copied.
enum class StepsMeanwhile {
    left_out,   ///< the copy is of the moment when it was begun
    copied_too  ///< it is copied again: work goes on in the copy, and nobody would look for them in the former project
};

/// Writes a complete copy of a project, there only once it is whole. Works while a run writes into the project. Throws
/// Error(output), also when there is a file of that name: a project is never replaced.
void copyProject(ProjectFile& project, const std::filesystem::path& target, StepsMeanwhile meanwhile);

}  // namespace eyrie::ui
