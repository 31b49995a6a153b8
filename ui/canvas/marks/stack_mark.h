#pragma once

#include <QColor>
#include <opencv2/core/types.hpp>
#include <vector>

namespace eyrie::ui {

/// An image stack as it is drawn over the video: its master vector and the motion vectors related to it.
struct StackMark {
    int id = 0;
    cv::Point2d position{0, 0};  ///< of the master vector, px
    double heading = 0;          ///< radians, clockwise on screen from +x
    int height = 0;              ///< layers
    std::vector<cv::Point2f> related;
};

/// The colour of a stack, in the canvas and in lists: neighbours in number lie far apart in hue.
QColor stackColour(int id);

}  // namespace eyrie::ui
