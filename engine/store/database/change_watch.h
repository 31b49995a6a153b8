#pragma once

#include <optional>

#include "store/project/project_file.h"

namespace eyrie {

/// Tells a reader whether it has to look again, without reading anything of the project.
class ChangeWatch {
 public:
    /// `project` must outlive the watch.
    explicit ChangeWatch(ProjectFile& project) : project_(project) {}

    /// Whether others (other connections, of this program too) committed anything since this was asked last; true when
    /// asked for the first time. Throws Error(project).
    bool changed();

 private:
    ProjectFile& project_;
    std::optional<int> version_;
};

}  // namespace eyrie
