#pragma once

#include <array>
#include <functional>
#include <optional>
#include <stop_token>

#include "chain/chain_options.h"
#include "chain/chain_run.h"
#include "chain/scale/scale_outcomes.h"
#include "core/values/frame.h"
#include "core/values/scene_scale.h"
#include "io/video/frame_source.h"

namespace eyrie {

/// Frames of one look; where no more are there, what these show decides.
inline constexpr int kFramesOfLook = 40;

/// The chain that looks: whatever detector the run is to use, here the classifier has to say what is a vehicle.
ChainOptions lookingOptions(const ChainOptions& options);

/// The last frame that a look at a range may read; nothing where the video has no frame of it.
std::optional<FrameIndex> lastOfLook(const FrameSource& source, FrameRange range);

/// Where looks of so many frames begin: at the start, in the middle and at the end. They may overlap.
std::array<FrameIndex, 3> startsOfLooks(FrameIndex first, FrameIndex last, int frames);

/// The frame at a place of a look, from 0.
using FrameOfLook = std::function<Frame(int)>;

/// What the chain finds in `count` frames under an assumed scale, of tracks in those from the time on when some have
/// formed: the fifteenth of a full look, earlier in a shorter one. `tell` is called after every frame.
ScaleOutcome outcomeUnder(int count, const FrameOfLook& frame_of, const ChainOptions& options, const SceneScale& scale,
                          const std::stop_token& stop, const std::function<void()>& tell);

}  // namespace eyrie
