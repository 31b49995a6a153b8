#pragma once

#include <cstddef>
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/values/last_frame.h"
#include "tracking/ground_motion.h"

namespace eyrie {

/// How the ground is turned and enlarged in each picture against the first one of its stretch: the frames that are
/// registered to each other without a gap, a limited time and zoom. What lies on the ground in one direction, as
/// shadows do, is carried so.
class GroundTurns {
 public:
    /// Of the frames `first` … `last`, measured in the middle of the pictures. `longest`: frames of a stretch; errors
    /// add up, and the sun goes on.
    GroundTurns(const GroundMotion& ground, FrameIndex first, FrameIndex last, int longest = kLastFrame);

    struct Turn {
        FrameIndex stretch = 0;  ///< the first frame of its stretch
        double angle = 0;        ///< radians, clockwise on screen
        double enlargement = 1;  ///< beyond what the slope of the scale tells of the place
    };
    /// `frame` must be one of them.
    const Turn& at(FrameIndex frame) const { return turns_[static_cast<std::size_t>(frame - first_)]; }
    FrameIndex firstFrame() const { return first_; }
    FrameIndex lastFrame() const { return first_ + static_cast<FrameIndex>(turns_.size()) - 1; }

 private:
    FrameIndex first_;
    std::vector<Turn> turns_;
};

}  // namespace eyrie
