#pragma once

#include <limits>

namespace eyrie {

/// What speaks for a track to be a vehicle that moves, and against it, gathered along its life.
struct TrackEvidence {
    double detected = 0;      ///< share of its states that were detected, apart from those in which it stands
    double looked_alike = 0;  ///< share of its detected states in which the classifier took it for a whole vehicle
    /// Mean decision value of the classifier at its detections, each held between −6 and 12; NaN: nobody looked.
    double decision = std::numeric_limits<double>::quiet_NaN();
    double life_s = 0;      ///< s, without those in which it stands
    double flow_px = 0;     ///< px/frame by which the ground moved through the picture there; 0: not known
    double flow_ratio = 0;  ///< own motion over the ground, to that
    double alignment = 0;   ///< cosine of the angle between both; −1: it sticks to the image
    double score = 0;       ///< what comes of it, 0 … 1: the probability that it is a vehicle that moves
};

}  // namespace eyrie
