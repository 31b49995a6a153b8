#pragma once

#include "store/project/project_file.h"

namespace eyrie {

/// While it lives, what is read of a project is what it was at the first reading, whatever others commit meanwhile.
/// Nothing may be written through the connection.
class Snapshot {
 public:
    /// `project` must outlive it. Throws Error(project).
    explicit Snapshot(ProjectFile& project);
    ~Snapshot();
    Snapshot(const Snapshot&) = delete;
    Snapshot& operator=(const Snapshot&) = delete;

 private:
    ProjectFile& project_;
};

}  // namespace eyrie
