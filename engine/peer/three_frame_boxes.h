#pragma once

#include <optional>
#include <vector>

#include "core/values/frame.h"
#include "motion/differences/registered_frames.h"
#include "peer/peer_options.h"

namespace eyrie {

/// What differs from before and after in one picture.
struct BoxesOfPicture {
    FrameIndex frame = 0;
    std::vector<OrientedBox> boxes;  ///< upright, in reading order of their areas' first pixels
};

/// The detector of the peer: the smaller one of the differences to the pictures `gap` before and after, laid over it;
/// one threshold; an upright box around every connected area.
class ThreeFrameBoxes {
 public:
    explicit ThreeFrameBoxes(const PeerOptions& options) : options_(options), frames_(2 * options.gap) {}

    /// Takes the next frame and answers for the picture `gap` ones before it. Nothing where that has nothing before or
    /// after it, and where the frame adds no picture (not registered, or repeated).
    std::optional<BoxesOfPicture> next(const Frame& frame, const Registration& registration);

 private:
    std::vector<OrientedBox> boxesOf(const cv::Mat& moving) const;

    PeerOptions options_;
    RegisteredFrames frames_;
};

}  // namespace eyrie
