#pragma once

#include <stop_token>

#include "chain/scale/scale_estimation.h"

namespace eyrie {

/// How the scale changes over the pictures of an oblique view: the classifier says at some places of up to three
/// stretches of the video at what scale something that moves looks most like a vehicle, the camera's way there says how
/// oblique the view is, and fitSlope() makes of both what it can. Flat where no slope is sure, or where no classifier
/// can be loaded. Takes about a second. `told`, if any, learns after every frame how far the look is.
ScaleSlope estimateSlope(FrameSource& source, FrameRange range, const ChainOptions& options, const SceneScale& scale,
                         const std::stop_token& stop, const ScaleProgress& told = {});

}  // namespace eyrie
