#include "core/scene_name.h"

#include <string_view>

namespace eyrie {
namespace {

constexpr std::string_view kScenePrefix = "scene:";

}  // namespace

std::string sceneName(const std::string& scene) {
    return std::string(kScenePrefix) + scene;
}

bool isScene(const std::string& input) {
    return input.starts_with(kScenePrefix);
}

std::string sceneOf(const std::string& input) {
    return isScene(input) ? input.substr(kScenePrefix.size()) : input;
}

}  // namespace eyrie
