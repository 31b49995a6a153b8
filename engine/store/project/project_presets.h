#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "store/project/project_file.h"

namespace eyrie {

/// A named set of parameter values that is part of a project.
struct PresetRecord {
    std::string name;
    std::string saved_utc;                                    ///< ISO 8601; set by the store
    std::vector<std::pair<std::string, std::string>> values;  ///< as text, in the order of declaration
};

/// All presets of a project, by name. Throws Error(project).
std::vector<PresetRecord> presets(ProjectFile& project);
std::optional<PresetRecord> preset(ProjectFile& project, const std::string& name);
/// Keeps a preset in one transaction, in place of one of the same name. Throws Error(parameter) for an empty name,
/// Error(output) when the disk is full.
void savePreset(ProjectFile& project, const PresetRecord& preset);
/// Throws Error(parameter) when there is none of the name, or when `to` is taken or empty.
void renamePreset(ProjectFile& project, const std::string& from, const std::string& to);
/// Throws Error(parameter) when there is none of the name.
void removePreset(ProjectFile& project, const std::string& name);

}  // namespace eyrie
