#pragma once

#include <cmath>

#include "core/geometry/angle.h"
#include "core/geometry/oriented_box.h"

namespace eyrie {

/// Whether a box lies along the image's axes to the last digit, as those of a hand or a format that does not turn
/// boxes.
inline bool isUpright(const OrientedBox& box) {
    const double quarters = box.heading / (kPi / 2);
    return std::abs(quarters - std::round(quarters)) < 1e-9;
}

}  // namespace eyrie
