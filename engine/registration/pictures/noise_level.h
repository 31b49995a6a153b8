#pragma once

#include "registration/pictures/padded_picture.h"

namespace eyrie {

/// Standard deviation of the sensor noise in grey levels: from the lower quartile of a Laplacian's magnitude, so that
/// texture, which fills the upper part, hardly counts. At least `kQuietest`, since clipped or compressed pictures show
/// none. (The mask is that of J. Immerkær, "Fast noise variance estimation", 1996.)
double noiseLevel(const PaddedPicture& picture);

inline constexpr double kQuietest = 0.5;

}  // namespace eyrie
