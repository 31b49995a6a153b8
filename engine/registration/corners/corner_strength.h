#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "registration/pictures/padded_picture.h"

namespace eyrie {

/// A local maximum of corner strength.
struct StrengthPeak {
    int x = 0;
    int y = 0;
    float strength = 0;
};

/// Which maxima of corner strength are of interest.
struct StrengthLimits {
    int window_radius = 1;    ///< the structure tensor is summed over (2r + 1)² pixels, r = 1 … 3
    float min_strength = 0;   ///< see `findStrengthPeaks`
    float min_roundness = 0;  ///< 0 accepts edges, 1 perfectly isotropic texture only
    int margin = 4;           ///< peaks keep this distance to the border of the picture, at least radius + 2
};

/// Appends the peaks of rows [first_row, end_row) in raster order. Strength is that of Förstner and Gülch 1987,
/// w = det N / tr N, where N is the structure tensor summed over the window (Sobel gradients, grey levels per px), so
/// that noise²/w is the variance, in px², with which noise lets the window be located; roundness is 4 det N / tr² N.
/// A peak is larger than its neighbours above and to the left and not smaller than the others (3×3).
void findStrengthPeaks(const PaddedPicture& picture, int first_row, int end_row, const StrengthLimits& limits,
                       std::vector<StrengthPeak>& peaks);

/// The point nearest to all edges in the 7×7 window about (x, y), weighted by their gradient (Förstner and Gülch 1987).
/// Keeps (x, y) where it would move by more than 1.5 px. (x, y) must be 4 px inside the picture.
cv::Point2f refineCorner(const PaddedPicture& picture, int x, int y);

}  // namespace eyrie
