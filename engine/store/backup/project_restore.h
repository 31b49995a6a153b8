#pragma once

#include <filesystem>

#include "store/backup/project_backup.h"

namespace eyrie {

/// Makes a project what it was when a copy of it was made. The present state is kept first ("before restoring"), which
/// is answered; `stopped` by the watch and `by_others` mean that nothing was changed. All changes at once or nothing,
/// also when killed or on a full disk; the file stays the same one. Where there is no project any more, the copy
/// becomes one.
///
/// Throws Error(project) while any other connection, of this process, too, has the project open, when the present state
/// cannot be kept, or when the copy cannot be read; Error(output) when the project cannot be written.
BackupResult restoreBackup(const std::filesystem::path& project, const ProjectBackup& backup,
                           const CopyWatch& watch = {});

/// Makes a new project of a copy. Answers false when stopped. Throws Error(output) when `fresh` exists already or
/// cannot be written, Error(project) when the copy cannot be read.
bool restoreAsNew(const ProjectBackup& backup, const std::filesystem::path& fresh, const CopyWatch& watch = {});

}  // namespace eyrie
