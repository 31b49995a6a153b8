#pragma once

#include "core/values/ids.h"

namespace eyrie {

/// No video is longer: a day at 230 frames a second.
inline constexpr FrameIndex kLastFrame = 20'000'000;

}  // namespace eyrie
