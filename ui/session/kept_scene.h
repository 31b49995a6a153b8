#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "io/frame_source.h"

namespace eyrie::ui {

/// A built-in scene whose frames are rendered once and then kept as files in `folder` (without loss), so that playing
/// it again is quick. Frames kept by another build of the program are thrown away. A folder that cannot be written
/// costs time only. Throws Error(parameter) for an unknown scene.
std::unique_ptr<FrameSource> openKeptScene(const std::string& scene, const std::filesystem::path& folder);

/// Where they are kept: `<user's cache folder>/eyrie/scenes`.
std::filesystem::path sceneFolder();

}  // namespace eyrie::ui
