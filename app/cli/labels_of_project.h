#pragma once

#include <optional>

#include "store/project/project_file.h"
#include "store/runs/run_store.h"

namespace eyrie::cli {

/// The video of a project that labels belong to: the only one, or that of number `id`. Throws Error(parameter) saying
/// which there are, Error(project) when there is none.
SequenceRecord chosenSequence(ProjectFile& project, std::optional<int> id);

}  // namespace eyrie::cli
