#pragma once

#include <filesystem>
#include <stop_token>

#include "store/project/project_file.h"

namespace eyrie::cli {

/// Opens a project for reading, and tells on standard error what should be told about that.
ProjectFile openForReading(const std::filesystem::path& project);

/// To be called before a command writes into a project: brings it up to date and keeps its state of today, if it is
/// there at all, and tells on standard error when no copy could be kept; the command goes on all the same. Shows how
/// far it is. Answers false when it was stopped: the command should end, nothing is changed yet. Throws Error(project)
/// when the project cannot be opened.
bool keepEarlierState(const std::filesystem::path& project, std::stop_token stop = {});

}  // namespace eyrie::cli
