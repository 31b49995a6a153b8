#pragma once

#include <algorithm>
#include <opencv2/core/types.hpp>

namespace eyrie {

/// How the number of pixels per metre changes over the picture. Seen at an angle, flat ground has a horizon, and a
/// metre across the line of sight covers pixels in proportion to its place's distance from that line: a linear function
/// of the place, of which two numbers are enough. Both are 0 where the camera looks straight down.
struct ScaleSlope {
    static constexpr double kLeast = 0.2;   ///< factors are kept from here …
    static constexpr double kMost = 4;      ///< … to here: near the horizon nothing can be said, nor under the camera
    static constexpr double kSteepest = 1;  ///< either growth per px; steeper ones are damage

    double right_per_px = 0;  ///< relative growth of pixels per metre for a pixel to the right
    double down_per_px = 0;   ///< … for a pixel downwards
    double centre_x = 0;      ///< px, place that growth counts from, where the scale is the given one
    double centre_y = 0;

    /// About the middle of pictures of a size.
    static ScaleSlope ofPicture(cv::Size size, double right_per_px, double down_per_px) {
        return {right_per_px, down_per_px, (size.width - 1) / 2.0, (size.height - 1) / 2.0};
    }

    bool operator==(const ScaleSlope&) const = default;

    cv::Point2d centre() const { return {centre_x, centre_y}; }
    /// A direction in which the scale stays the same: that of the horizon, of any length; level where it is flat.
    cv::Point2d level() const { return isFlat() ? cv::Point2d(1, 0) : cv::Point2d(-down_per_px, right_per_px); }
    bool isFlat() const { return right_per_px == 0 && down_per_px == 0; }
    /// The same slope with the growth counted from another place, where the scale is the given one then.
    ScaleSlope countedFrom(cv::Point2d place) const {
        const double factor = factorAt(place);
        return {right_per_px / factor, down_per_px / factor, place.x, place.y};
    }
    /// The same slope when the camera shows everything larger by this factor.
    ScaleSlope zoomed(double by) const { return {right_per_px / by, down_per_px / by, centre_x, centre_y}; }
    /// Pixels per metre at a place as a multiple of those at the centre; exactly 1 everywhere where it is flat.
    double factorAt(cv::Point2d place) const {
        if (isFlat()) return 1;
        const double right = place.x - centre_x;
        const double down = place.y - centre_y;
        return std::clamp(1 + right_per_px * right + down_per_px * down, kLeast, kMost);
    }
};

}  // namespace eyrie
