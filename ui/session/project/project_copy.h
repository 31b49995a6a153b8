#pragma once

#include <filesystem>

#include "store/database/change_watch.h"
#include "store/project/project_file.h"

namespace eyrie::ui {

/// What becomes of what is done while a project is copied.
enum class StepsMeanwhile {
    left_out,   ///< the copy is of the moment when it was begun
    copied_too  ///< it is copied again: work goes on in the copy, and nobody would look for them in the former project
};

/// Writes a complete copy of a project, there only once it is whole. Works while a run writes into the project. Throws
/// Error(output), also when there is a file of that name: a project is never replaced.
void copyProject(ProjectFile& project, const std::filesystem::path& target, StepsMeanwhile meanwhile);

/// A copy in which work is to go on. It is made while people work in the project; what they did meanwhile is copied
/// when it is put in place. All throw as copyProject() does.
class ProjectMove {
 public:
    /// Makes the copy. `project` must outlive this.
    ProjectMove(ProjectFile& project, std::filesystem::path target);
    /// What was not put in place goes.
    ~ProjectMove();
    ProjectMove(const ProjectMove&) = delete;
    ProjectMove& operator=(const ProjectMove&) = delete;

    const std::filesystem::path& target() const { return target_; }
    /// Copies again if anything of the project is another than when it was copied, and puts the copy in place. Whoever
    /// goes on in the copy writes into the project no more.
    void finish();

 private:
    void copy();
    bool changedSince();

    ProjectFile& project_;
    std::filesystem::path target_;
    std::filesystem::path part_;
    ChangeWatch others_;   ///< what other connections commit
    int own_changes_ = 0;  ///< of this one, when it was copied
};

}  // namespace eyrie::ui
