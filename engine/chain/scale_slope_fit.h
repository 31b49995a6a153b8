#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "core/values/scale_slope.h"
#include "detection/sliding_window/scale_votes.h"

namespace eyrie {

/// How the scale changes over pictures of a size, from places in them where something looks like a vehicle: the linear
/// function of the place that fits pixels per metre, robustly, for lorries vote for a scale that is too fine and
/// pairs of cars for one too coarse. A horizon that is not level needs more evidence than a level one. Nothing where
/// votes are few or lie too close together to tell a slope from chance, or where the scale may as well be the same
/// everywhere.
std::optional<ScaleSlope> fitSlope(const std::vector<ScaleVote>& votes, cv::Size image);

}  // namespace eyrie
