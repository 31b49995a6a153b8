#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "chain/scale/camera_slope.h"
#include "core/values/scale_slope.h"
#include "detection/sliding_window/scale_votes.h"

namespace eyrie {

/// How the scale changes over pictures of a size, from places in them where something looks like a vehicle: the linear
/// function of the place that fits pixels per metre. Votes that lie far off count all the same, for a part of a car may
/// look like one as well as two of them do. Around the picture's middle, where `gsd_m_per_px` was given or estimated, a
/// car may be somewhat smaller or larger than usual; a horizon that is not level needs more evidence than a level one.
/// What the camera's way says of the growth downwards counts beside the votes, and alone where there are few. A slope
/// that only the camera tells is counted from where the vehicles are, if they say that the scale holds there rather
/// than in the middle: it is that of the slope's centre in any case. Flat unless a slope explains all that far
/// better than none, and matters.
ScaleSlope fitSlope(const std::vector<ScaleVote>& votes, cv::Size image, double gsd_m_per_px,
                    const CameraSlope& camera);

/// A scale that changes downwards over the picture, whose horizon is level.
struct ViewFit {
    double gsd_m_per_px = 0;  ///< in the picture's middle
    ScaleSlope slope;         ///< never flat
};

/// Scale and slope together, where nothing is known of either: a view so oblique that no scale fits the whole of it.
/// The horizon may lie in the picture. Nothing unless most votes agree on both, and better than on one scale for all;
/// else what fits best, then what fits about as well, none of them sure before the chain finds traffic with it.
std::vector<ViewFit> fitView(const std::vector<ScaleVote>& votes, cv::Size image, const CameraSlope& camera);

}  // namespace eyrie
