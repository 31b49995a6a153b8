#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>

#include "chain/chain_run.h"
#include "core/chain_stage.h"
#include "core/labels/box_record.h"
#include "rerun/replay.h"

namespace eyrie {

/// Some frames of a stored run done again with other parameters.
struct RangeResult {
    /// Tracks are finished and have ids of their own.
    std::map<FrameIndex, std::shared_ptr<const FrameResult>> frames;
    ChainStage start = ChainStage::none;  ///< what differs from the run first
    SceneScale scale;                     ///< of the run
    TrackClassOptions classes;            ///< by which classes are told
    bool exact = false;  ///< as a run with these parameters: nothing before the frames done can play a part
};

/// Told of every frame as it is done, ascending, and of those before the range, which only lead up to it (null then).
/// Its tracks may change when they are finished.
using OnRangeFrame =
    std::function<void(const std::shared_ptr<const FrameResult>& result, int frames_done, int frames_total)>;

/// Does a range of a stored run again with other parameters, from the first stage that differs, on what the run stored
/// of the stages before. Begins early enough for tracks, stacks and backgrounds to be there. Frames that the run has
/// not done are left out. Nothing when `stop` was requested meanwhile. Throws Error(input | parameter | project).
std::optional<RangeResult> runRange(const ReplaySource& source, const ChainOptions& options, FrameRange range,
                                    const std::stop_token& stop, const OnRangeFrame& on_frame = {});

/// The same as boxes: every state of its tracks, with their classes by what is in the range, or its kept detections
/// (without ids).
BoxesByFrame trackBoxesOf(const RangeResult& result);
BoxesByFrame detectionBoxesOf(const RangeResult& result);

}  // namespace eyrie
