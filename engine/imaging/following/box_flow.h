#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry/homography.h"
#include "core/geometry/oriented_box.h"

namespace eyrie {

/// How a box moved from one picture to the next, by the corners inside it.
struct BoxFlow {
    OrientedBox box;    ///< in the next picture; as predicted where too few corners agree
    int corners = 0;    ///< tracked there and back
    int agreeing = 0;   ///< those that move together
    double growth = 1;  ///< of what they lie on, beyond what is predicted
};

/// Limits of the corners by which a box is moved from one picture to the next.
struct BoxFlowOptions {
    int max_corners = 40;
    double max_forward_backward_px = 0.7;
};

/// `predicted` is where the box is expected in `next`; both pictures CV_8UC1 of the same size.
BoxFlow flowOf(const cv::Mat& current, const cv::Mat& next, const OrientedBox& box, const OrientedBox& predicted,
               const BoxFlowOptions& options);

/// The camera's motion between two pictures from the corners around a box: a turn, a scale and a shift. The identity
/// where there are too few.
Homography cameraAround(const cv::Mat& current, const cv::Mat& next, const OrientedBox& box);

}  // namespace eyrie
