#pragma once

#include <opencv2/core/mat.hpp>

namespace eyrie {

/// How a picture is made easier to look at. Nothing is measured on what comes of it.
struct PictureLook {
    double brightness = 0;  ///< −1 … 1: added, as a share of the range
    double contrast = 0;    ///< −1 … 1: −1 is flat, 0 as filmed, 1 is four times as steep, around the middle
    bool even = false;      ///< local contrast evened out (CLAHE): shows what lies in the dark and in haze

    bool plain() const { return brightness == 0 && contrast == 0 && !even; }
    bool operator==(const PictureLook&) const = default;
};

/// A grey or blue-green-red picture of 8 bit; colours keep their hue. Others, and empty ones, come back as they are;
/// the picture itself is never written.
cv::Mat withLook(const cv::Mat& picture, const PictureLook& look);

}  // namespace eyrie
