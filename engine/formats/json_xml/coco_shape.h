#pragma once

#include <array>
#include <optional>

#include "core/geometry/oriented_box.h"
#include "formats/json_xml/json_place.h"
#include "formats/label_file.h"

namespace eyrie {

/// Makes boxes of the annotations of COCO and its kin, and remembers what was odd about them.
class CocoShapes {
 public:
    /// The box that `bbox`, DIVE's rotation and an outline of four corners tell; without a `bbox` that of the outline.
    /// Nothing where there is neither. Throws Error(input) for numbers that are none.
    std::optional<OrientedBox> boxOf(const JsonPlace& annotation);
    void tell(LabelFile& labels) const;

 private:
    using Corners = std::array<cv::Point2d, 4>;
    OrientedBox turned(const OrientedBox& upright, const std::optional<Corners>& corners,
                       std::optional<double> rotation);
    /// Four corners that nobody says the front of: a turned rectangle lies along its long side, anything else is
    /// bounds.
    OrientedBox boxOfOutline(const Corners& corners, const OrientedBox& upright);

    int without_box_ = 0, by_outline_ = 0, odd_outlines_ = 0, without_front_ = 0;
};

}  // namespace eyrie
