#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/diagnoser.h"

namespace eyrie {

/// The list as a table: kind, first_frame, last_frame, count, objects and tracks (ids with blanks between), frame and
/// box (x, y, length, width in px, heading in degrees) of the place that shows the cause, cause (the most frequent one
/// of the stretch), detail (of that frame, which it names where there are several), frames_of_cause (places with the
/// cause). `separator`: ',' for files, a tab for the clipboard.
std::string errorTable(const std::vector<DiagnosedError>& errors, char separator = ',');

/// Throws Error(output); the file is either complete or as it was before.
void writeErrorCsv(const std::filesystem::path& path, const std::vector<DiagnosedError>& errors);

}  // namespace eyrie
