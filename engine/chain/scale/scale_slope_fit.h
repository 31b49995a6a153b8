#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/values/scale_slope.h"
#include "detection/sliding_window/scale_votes.h"

namespace eyrie {

/// How the scale changes over pictures of a size, from places in them where something looks like a vehicle: the linear
/// function of the place that fits pixels per metre. Votes that lie far off count all the same, for a part of a car may
/// look like one as well as two of them do. Around the picture's middle, where `gsd_m_per_px` was given or estimated, a
/// car may be somewhat smaller or larger than usual; a horizon that is not level needs more evidence than a level one.
/// Flat unless a slope explains the votes far better than none, and matters.
ScaleSlope fitSlope(const std::vector<ScaleVote>& votes, cv::Size image, double gsd_m_per_px);

}  // namespace eyrie
