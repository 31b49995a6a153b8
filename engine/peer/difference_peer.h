#pragma once

#include <deque>
#include <utility>
#include <vector>

#include "core/values/frame.h"
#include "core/values/frame_result.h"
#include "peer/three_frame_boxes.h"

namespace eyrie {

/// "Three-frame difference with SORT": the simplest method that finds and follows vehicles under a moving camera, to be
/// compared with. It shares reading and registration with the chain and nothing else. A picture is answered for once
/// the one `gap` later is there, so results come late; the last ones of a video have no boxes.
class DifferencePeer {
 public:
    using Result = std::pair<Frame, FrameResult>;

    explicit DifferencePeer(const PeerOptions& options) : gap_(options.gap), boxes_(options), sort_(options.sort) {}

    /// Takes the next frame with its registration; returns those that are done, in ascending order.
    std::vector<Result> next(const Frame& frame, const FrameMotion& motion);
    /// The frames that are still to be returned, when no more come.
    std::vector<Result> finish();

 private:
    /// The longest waiting one with the tracks that these boxes lead to.
    Result followed(const std::vector<OrientedBox>& boxes);

    int gap_;
    ThreeFrameBoxes boxes_;
    SortTracker sort_;
    std::deque<Result> waiting_;  ///< without results yet
};

}  // namespace eyrie
