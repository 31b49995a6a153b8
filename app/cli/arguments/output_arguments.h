#pragma once

#include <filesystem>
#include <vector>

#include "io/output_files.h"

namespace CLI {
class App;
}

namespace eyrie::cli {

/// What every command that writes files asks before it begins: may these be written (io/output_files.h)?
struct OutputArguments {
    bool force = false;  ///< replace files of the same kind without a question

    void addTo(CLI::App& command);
    /// Throws Error(output | project) for what may not be written. Files that would be replaced need --force or, when a
    /// person is at the terminal, a yes. Projects to be added to are opened, so that one that cannot be used is told
    /// now.
    void check(const std::vector<OutputFile>& outputs, const std::vector<std::filesystem::path>& inputs) const;
};

/// A project that gets something added, or is made.
inline OutputFile growingProject(const std::filesystem::path& path) {
    return {path, FileKind::project, true, false};
}

}  // namespace eyrie::cli
