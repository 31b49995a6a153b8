#pragma once

#include <memory>
#include <vector>

#include "core/values/detection.h"
#include "core/values/motion_roi.h"
#include "detection/detection_trace.h"

namespace eyrie {

struct VehicleModel;

/// What a detector makes of a motion ROI before the parameters come into play that are tuned most; see prepare().
class PreparedArea {
 public:
    virtual ~PreparedArea() = default;
    virtual std::size_t bytes() const = 0;  ///< it takes, roughly
};

/// Finds the objects of one motion ROI (Teutsch §5.4). The exchangeable step of the chain: stateless, so that
/// `detect` may be called for several ROIs at once.
class Detector {
 public:
    virtual ~Detector() = default;

    /// Boxes in image coordinates with the ROI's heading, its velocity and its cluster index. `vectors` and `score`
    /// stay empty unless the detector has a value of its own: removal counts the motion vectors. An empty ROI gives
    /// none.
    virtual std::vector<Detection> detect(const MotionRoi& roi, DetectionTrace* trace = nullptr) const = 0;

    /// The part of `detect` that does not depend on parameters declared as decisionOnly(), for detecting in the same
    /// area many times. Null where there is no such part.
    virtual std::unique_ptr<const PreparedArea> prepare(const MotionRoi&) const { return nullptr; }
    /// Exactly what `detect` gives. `prepared`: of the same area, by a detector whose other parameters are the same.
    virtual std::vector<Detection> decide(const MotionRoi& roi, const PreparedArea* /*prepared*/) const {
        return detect(roi);
    }

    /// The trained classifier that takes part, for who asks it about other boxes; null where none does. Lives as long
    /// as the detector; copies of it share everything. No default: who hands on to other detectors hands this on, too.
    virtual const VehicleModel* model() const = 0;
};

}  // namespace eyrie
