#pragma once

#include <vector>

#include "core/labels/box_record.h"
#include "evaluation/matching.h"

namespace eyrie {

/// How far the matched boxes are from the true ones; means over all matched pairs, 0 without any.
struct BoxErrors {
    int pairs = 0;
    bool has_headings = true;   ///< false where upright boxes were compared: headings then mean nothing
    double centre_px = 0;       ///< distance of the centres
    double length_px = 0;       ///< absolute
    double width_px = 0;        ///< absolute
    double length_bias_px = 0;  ///< result − truth: positive where results are too long
    double width_bias_px = 0;
    double heading_degrees = 0;       ///< absolute, modulo 360: front and rear must be right, in [0, 180]
    double heading_axis_degrees = 0;  ///< absolute, modulo 180: the axis alone, in [0, 90]
};

/// `upright`: sizes of the enclosing upright boxes are compared.
BoxErrors boxErrors(const BoxesByFrame& truth, const BoxesByFrame& result, const std::vector<FrameMatch>& matches,
                    bool upright);

}  // namespace eyrie
