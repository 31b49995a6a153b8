#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <vector>

#include "chain/scale/camera_slope.h"
#include "chain/scale/scale_estimation.h"
#include "chain/scale/stretch_look.h"

namespace eyrie {

/// A view that was read off what moves in it.
struct EstimatedView {
    ScaleEstimate middle;
    ScaleSlope slope;
};

/// ScaleEstimate::uncertainty of a view that was read off so many vehicles at once, of which nobody knows the lengths.
double uncertaintyOfView(std::size_t vehicles_at_once);

/// What a look for a view sees.
struct ViewLook {
    /// That were looked at: the beginning, the middle and the end, as one where they touch.
    std::vector<Stretch> stretches;
    std::vector<ScaleVote> votes;
    std::size_t most_at_once = 0;  ///< votes of one frame
    CameraSlope camera;
};

/// What moves, and the camera's way, is looked at. Throws Error(input) where no classifier can be loaded.
ViewLook lookForView(FrameSource& source, FrameRange range, const ChainOptions& options, double frame_rate_hz,
                     const std::stop_token& stop, const ScaleProgress& told = {});

/// Scale and slope of a view in which no scale shows traffic, for a vehicle that comes nearer changes its size all the
/// time. What fits most of what that look sees is tried there. Nothing where the chain finds no traffic under that
/// either. Throws Error(input) where no classifier can be loaded.
std::optional<EstimatedView> estimateView(FrameSource& source, FrameRange range, const ChainOptions& options,
                                          double frame_rate_hz, const std::stop_token& stop,
                                          const ScaleProgress& told = {});

}  // namespace eyrie
