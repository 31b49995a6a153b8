#include "io/video/frame_colour.h"

#include <opencv2/imgproc.hpp>

namespace eyrie {

cv::Mat colourOf(const Frame& frame) {
    if (!frame.colour.empty()) return frame.colour;
    cv::Mat colour;
    cv::cvtColor(frame.gray, colour, cv::COLOR_GRAY2BGR);
    return colour;
}

}  // namespace eyrie
