#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "io/video/frame_source.h"

namespace eyrie {

/// A built-in scene as if it were a video: frames are rendered when they are read. `seed` 0: the scene's own. Throws
/// Error(parameter) for an unknown name.
std::unique_ptr<FrameSource> openScene(const std::string& name, std::uint32_t seed = 0);

}  // namespace eyrie
