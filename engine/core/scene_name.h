#pragma once

#include <string>

/// Built-in scenes, where the path of a video could stand.
namespace eyrie {

/// "scene:seq1".
std::string sceneName(const std::string& scene);

/// Whether an input is the name of a built-in scene and not a path.
bool isScene(const std::string& input);

/// "seq1" of "scene:seq1"; what is no such name stays as it is.
std::string sceneOf(const std::string& input);

}  // namespace eyrie
