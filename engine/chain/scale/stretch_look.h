#pragma once

#include <functional>
#include <opencv2/core/matx.hpp>
#include <stop_token>
#include <vector>

#include "chain/chain_options.h"
#include "chain/scale/look_progress.h"
#include "detection/sliding_window/scale_votes.h"
#include "io/video/frame_source.h"
#include "motion/clusters/motion_clustering.h"

namespace eyrie {

/// Frames that follow each other.
struct Stretch {
    FrameIndex first = 0;
    int count = 0;
};

/// What moves in a stretch, and the camera's way.
struct StretchLook {
    std::vector<ScaleVote> votes;
    std::size_t most_at_once = 0;    ///< votes of one frame
    std::vector<cv::Matx33d> steps;  ///< see CameraWay
    int frames = 0;                  ///< that could be read
};

/// Says at what scales that which moves in a video looks like vehicles.
class StretchLooker {
 public:
    /// What moves is linked under `scale`, and looked at under `scales`. The options must outlive this. Throws
    /// Error(input) where no classifier can be loaded.
    StretchLooker(const ChainOptions& options, const SceneScale& scale, const ScaleRange& scales);

    /// Only frames for whose place in the stretch, from 0, `votes_at` holds have votes. The look ends before a frame
    /// that cannot be read: the run will come to it and report it.
    StretchLook look(FrameSource& source, const Stretch& stretch, const std::function<bool(int)>& votes_at,
                     const std::stop_token& stop, LookProgress& progress) const;

 private:
    std::vector<ScaleVote> votesIn(const Frame& frame, const FrameMotion& motion) const;

    const ChainOptions& options_;
    SceneScale scale_;
    ScaleRange scales_;
    ScaleLooker looker_;
    MotionClustering clustering_;
};

}  // namespace eyrie
