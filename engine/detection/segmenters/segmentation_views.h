#pragma once

#include <opencv2/core/mat.hpp>

#include "core/values/motion_roi.h"
#include "core/values/scene_scale.h"

/// What general segmentation makes of a motion ROI (Teutsch fig. 5.1), to be looked at: one sees why none of them
/// separates vehicles from the street. No detector uses them. The same ROI always gives the same view.
namespace eyrie {

/// Segments as labels from 0, CV_32SC1 of the ROI's size; empty for an empty ROI.
/// SLIC superpixels with a side of about `side_m`.
cv::Mat superpixelSegments(const MotionRoi& roi, const SceneScale& scale, double side_m = 1.0);
/// Watershed of the gradient, flooded from its local minima; `smoothing_px`: deviation of the Gaussian before it.
cv::Mat watershedSegments(const MotionRoi& roi, double smoothing_px = 1.0);
/// Graph cut into background (0) and object (1): the ROI's border is background, the surroundings of the cluster's own
/// vectors may be object.
cv::Mat graphCutSegments(const MotionRoi& roi);
/// gPb with OWT and UCM: borders of the segments at every level of detail, as strong as the level at which they vanish;
/// CV_32FC1, see ContourHierarchy::contourMap(). Of grey values alone and without weights that were learned.
cv::Mat contourMap(const MotionRoi& roi);

/// The ROI with such borders blended in, the strongest in full colour, CV_8UC3.
cv::Mat drawContourMap(const cv::Mat& gray, const cv::Mat& contours, const cv::Scalar& colour = {0, 220, 255});
/// The ROI with the borders of the segments drawn in colour, CV_8UC3.
cv::Mat drawSegments(const cv::Mat& gray, const cv::Mat& labels, const cv::Scalar& colour = {0, 220, 255});

}  // namespace eyrie
