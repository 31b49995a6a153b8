#pragma once

#include <stop_token>
#include <vector>

#include "chain/scale/camera_slope.h"
#include "chain/scale/scale_estimation.h"
#include "detection/sliding_window/scale_votes.h"

namespace eyrie {

/// What a look for a slope sees.
struct SlopeLook {
    std::vector<ScaleVote> votes;
    CameraSlope camera;
};

/// The classifier says at some places of up to three stretches of the video at what scale something that moves looks
/// most like a vehicle, and the camera's way there is followed. Nothing is seen where no classifier can be loaded.
SlopeLook lookForSlope(FrameSource& source, FrameRange range, const ChainOptions& options, const SceneScale& scale,
                       const std::stop_token& stop, const ScaleProgress& told = {});

/// How the scale changes over the pictures of an oblique view: what fitSlope() makes of what that look sees. Flat where
/// no slope is sure. Takes about a second. `told`, if any, learns after every frame how far the look is.
ScaleSlope estimateSlope(FrameSource& source, FrameRange range, const ChainOptions& options, const SceneScale& scale,
                         const std::stop_token& stop, const ScaleProgress& told = {});

}  // namespace eyrie
