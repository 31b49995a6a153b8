#pragma once

#include <vector>

#include "core/detection.h"
#include "core/motion_roi.h"
#include "detection/detection_trace.h"

namespace eyrie {

/// Finds the objects of one motion ROI (Teutsch §5.4). The exchangeable step of the chain: stateless, so that
/// `detect` may be called for several ROIs at once.
class Detector {
 public:
    virtual ~Detector() = default;

    /// Boxes in image coordinates with the ROI's heading, its velocity and its cluster index. `vectors` and `score`
    /// stay empty unless the detector has a value of its own: removal counts the motion vectors. An empty ROI gives
    /// none.
    virtual std::vector<Detection> detect(const MotionRoi& roi, DetectionTrace* trace = nullptr) const = 0;
};

}  // namespace eyrie
