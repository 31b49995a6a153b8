#pragma once

#include <cmath>
#include <limits>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "core/geometry/oriented_box.h"

namespace eyrie {

/// Why a box that a detector delivered did not become a detection.
enum class Rejection {
    none,       ///< it was kept
    duplicate,  ///< fused into another detection (Teutsch §5.5.1)
    outlier,    ///< fewer than T_out motion vectors inside (Teutsch §5.5.2)
    size        ///< outside the size limits
};
inline constexpr int kRejectionCount = static_cast<int>(Rejection::size) + 1;

/// A moving object as seen in one frame, before tracking.
struct Detection {
    OrientedBox box;
    double score = 0;            ///< classifier value, or motion vectors per expected motion vector; higher is surer
    cv::Point2d velocity{0, 0};  ///< px/frame relative to the ground, of the motion vectors inside
    int cluster = -1;            ///< index of the motion cluster it came from
    std::vector<int> vectors;    ///< indices into FrameMotion::motion_vectors of those that make or lie in the box
    Rejection rejection = Rejection::none;
    bool complete = false;  ///< the box of a whole vehicle (classifier); other boxes may lack or join parts
    /// That it is a vehicle that moves, 0 … 1; NaN where it was not judged: rejected, or no classifier takes part.
    double probability = std::numeric_limits<double>::quiet_NaN();
    /// How much it looks like a vehicle to the classifier: the decision value of a window laid over the box, above 0
    /// for vehicles. NaN where nobody looked: rejected, no classifier takes part, or not one of the frames it looks at.
    double decision = std::numeric_limits<double>::quiet_NaN();
};

/// What results tell of it: its probability where it has one.
inline double shownScore(const Detection& detection) {
    return std::isnan(detection.probability) ? detection.score : detection.probability;
}

}  // namespace eyrie
