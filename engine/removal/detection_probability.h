#pragma once

#include <vector>

#include "core/values/detection.h"
#include "core/values/motion_vector.h"

namespace eyrie {

/// Gives every detection that was kept the probability that it is a vehicle that moves, from what one frame tells: what
/// the classifier said, how many motion vectors it has, and its motion beside the camera's. A logistic regression,
/// learned by tests/learn_track_score like that of tracks. For detectors in which a classifier takes part.
void judgeDetections(std::vector<Detection>& detections, const FrameMotion& motion);

}  // namespace eyrie
