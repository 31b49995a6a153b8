#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/motion_cluster.h"

namespace eyrie {

/// The search area of a detector: an extended motion cluster, turned so that the motion points up (Teutsch §5.4).
/// ROI coordinates: x right, y down, pixel centres at integers, one ROI pixel per image pixel; heading is −y.
struct MotionRoi {
    cv::Mat image;                     ///< CV_8UC1, upright
    cv::Mat inside;                    ///< CV_8UC1, 255 where the pixel lies in the video image, 0 in the padding
    cv::Matx23d image_from_roi;        ///< maps ROI pixels to image pixels
    OrientedBox box;                   ///< the extended cluster in the image
    int cluster = -1;                  ///< index of the motion cluster in the frame
    cv::Point2d velocity{0, 0};        ///< px/frame relative to the ground
    std::vector<cv::Point2f> vectors;  ///< the cluster's own motion vectors (or moving points) in ROI coordinates
    double zoom = 1;                   ///< of the frame; see Registration::zoom
    int stack_layers = 0;              ///< height of the image stack the pixels come from; 0: the raw image
};

}  // namespace eyrie
