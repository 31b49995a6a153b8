#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace eyrie {

/// A named set of parameter values, as text. Knows nothing of which parameters exist: that is `setParameters`' part.
struct Preset {
    std::string name;
    std::vector<std::pair<std::string, std::string>> values;  ///< in the order of the file
};

/// Reads `{"eyrie_preset": 1, "name": "…", "parameters": {"motion.min_speed": 1.0, …}}`; values may be numbers, true,
/// false or text. Throws Error(input) naming the file and the place.
Preset readPreset(const std::filesystem::path& path);

/// Writes such a file; numbers and truth values are written as such. Throws Error(output).
void writePreset(const std::filesystem::path& path, const Preset& preset);

}  // namespace eyrie
