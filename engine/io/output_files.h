#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/file_kind.h"

/// The one place that decides which files may be written: never what is read, never a project, never a file of another
/// kind; a file of the same kind only when somebody agrees. Commands and dialogs ask before they begin to work.
namespace eyrie {

/// A file that is going to be written.
struct OutputFile {
    std::filesystem::path path;      ///< empty: not wanted
    FileKind kind = FileKind::text;  ///< what will be written
    bool grows = false;  ///< added to where it exists (projects, lists), so nobody is asked; it may be read, too
    bool makes_folders = false;  ///< folders on the way to it are made
};

/// Checks what is to be written against what is read and what is there. Inputs are files or folders (then every file
/// in them is read) or lists of parts (then these are read, too); names of no file are skipped. Any project that this
/// process has open must be among the inputs: it is recognised as the same file (also through links) without being
/// opened. Devices and pipes are written to as they are.
///
/// Answers the existing files of the same kind that would be replaced; they need somebody's consent. Throws
/// Error(output) for everything that may not or cannot be written, and Error(project) where a project should be that is
/// none.
std::vector<std::filesystem::path> filesToReplace(const std::vector<OutputFile>& outputs,
                                                  const std::vector<std::filesystem::path>& inputs);

/// "a.csv", or "a.csv and 12 more": for questions and refusals.
std::string shortList(const std::vector<std::filesystem::path>& files);

}  // namespace eyrie
