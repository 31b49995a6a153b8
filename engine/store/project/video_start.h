#pragma once

#include <cstdint>
#include <optional>

#include "store/project/project_file.h"

namespace eyrie {

/// When the first frame of a video was taken, µs since 1970-01-01, as a person says: `given_us`, what is said now, else
/// what the project keeps of it; nothing where nobody said. Throws Error(project).
std::optional<std::int64_t> videoStartOf(ProjectFile& project, int sequence_id,
                                         std::optional<std::int64_t> given_us = {});

/// Keeps it, or forgets it. Throws Error(project | output), and Error(parameter) for what no calendar has.
void storeVideoStart(ProjectFile& project, int sequence_id, std::optional<std::int64_t> start_utc_us);

}  // namespace eyrie
