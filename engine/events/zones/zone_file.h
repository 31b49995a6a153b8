#pragma once

#include <filesystem>
#include <vector>

#include "core/review/zone.h"

namespace eyrie {

/// Reads zones, lines and arrows: {"eyrie_zones": 1, "zones": [{"name": "car park", "shape": "area", "fixed_to":
/// "ground", "frame": 0, "points": [[x, y], …]}]}. "shape" is area (the default), line or arrow, "fixed_to" ground (the
/// default) or image. Throws Error(input) naming the file and the place for all that is missing, misspelt, or no zone.
std::vector<Zone> readZones(const std::filesystem::path& path);

/// Writes what readZones() reads, in place of a file that is there. Throws Error(output).
void writeZones(const std::filesystem::path& path, const std::vector<Zone>& zones);

}  // namespace eyrie
