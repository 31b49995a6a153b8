#pragma once

#include <algorithm>
#include <cmath>

#include "core/values/scene_scale.h"

namespace eyrie {

/// How many frames last so many seconds, rounded.
inline int framesOf(double seconds, const SceneScale& scale) {
    return static_cast<int>(std::lround(std::min(seconds * scale.frame_rate_hz, 1e6)));
}

}  // namespace eyrie
