#pragma once

#include <filesystem>
#include <vector>

#include "core/geometry/homography.h"

namespace eyrie {

/// Reads a table `frame,h00,h01,h02,h10,h11,h12,h20,h21,h22` of maps from each frame into one common frame; ascending
/// frames. Throws Error(input) naming file, line and column, also for a frame that is there twice or a singular matrix.
std::vector<Homography> readHomographyCsv(const std::filesystem::path& path, FrameIndex to_frame = 0);

/// Writes such a table, exactly. Throws Error(output).
void writeHomographyCsv(const std::filesystem::path& path, const std::vector<Homography>& homographies);

}  // namespace eyrie
