#pragma once

#include <functional>
#include <stop_token>

#include "chain/chain_options.h"
#include "chain/scale/scale_outcomes.h"
#include "core/values/frame.h"
#include "core/values/scene_scale.h"

namespace eyrie {

/// The chain that looks: whatever detector the run is to use, here the classifier has to say what is a vehicle.
ChainOptions lookingOptions(const ChainOptions& options);

/// The frame at a place of a look, from 0.
using FrameOfLook = std::function<Frame(int)>;

/// What the chain finds in `count` frames under an assumed scale. `tell` is called after every frame.
ScaleOutcome outcomeUnder(int count, const FrameOfLook& frame_of, const ChainOptions& options, const SceneScale& scale,
                          const std::stop_token& stop, const std::function<void()>& tell);

}  // namespace eyrie
