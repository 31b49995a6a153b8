#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene_description.h"

namespace eyrie {

/// Names of the built-in scenes, in the order in which people read them.
const std::vector<std::string>& scenePresetNames();

/// A built-in scene. `seed` 0 stands for the preset's own. Throws Error(parameter) for an unknown name, listing the
/// known ones.
SceneDescription scenePreset(const std::string& name, std::uint32_t seed = 0);

}  // namespace eyrie
