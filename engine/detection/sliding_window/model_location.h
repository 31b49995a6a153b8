#pragma once

#include <filesystem>
#include <string>

namespace eyrie {

/// Name of the file of the model that comes with Eyrie.
inline constexpr const char* kShippedModel = "vehicle_chnftrs_adaboost.eyriemodel";

/// The word that stands for the model that is trained as the thesis says, and its file, which comes with Eyrie, too.
inline constexpr const char* kThesisModelWord = "thesis";
inline constexpr const char* kThesisModel = "vehicle_thesis.eyriemodel";

/// Where a model file is: `path` itself, or, when empty or "thesis", a shipped model: next to the program (in
/// `classifiers/` or `../share/eyrie/classifiers/`) or in the source tree it was built from. Throws Error(input) naming
/// every place that was looked at when there is none.
std::filesystem::path modelLocation(const std::string& path);

}  // namespace eyrie
