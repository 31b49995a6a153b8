#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/values/scene_scale.h"
#include "detection/sliding_window/sliding_window_options.h"
#include "learning/models/window_scanner.h"

/// From decision values to hypotheses of vehicles in an upright image (Teutsch §5.4.3, fig. 5.22).
namespace eyrie {

/// A window that the classifier takes for a vehicle.
struct WindowHypothesis {
    cv::Rect2d box;  ///< the vehicle by its edges, px of the image before rescaling; pixel 0 covers −0.5 … 0.5
    double decision = 0;
    double scale = 1;  ///< of the length
};

/// First non-maximum suppression: positions of the decision function that no 8-neighbour exceeds and that reach
/// `threshold`; of equal neighbours the first in reading order. `decision` is CV_32FC1.
std::vector<cv::Point> decisionPeaks(const cv::Mat& decision, double threshold);

/// Second non-maximum suppression: the surest stays, those that overlap it more than `overlap_threshold` (intersection
/// over union) go, and so on. Surest first; equals keep their order.
std::vector<WindowHypothesis> suppressOverlapping(std::vector<WindowHypothesis> hypotheses, double overlap_threshold);

/// Size to which an image is rescaled so that a vehicle of scale × the median car takes of the window what `fit` says.
cv::Size rescaledSize(cv::Size image, double scale, const SlidingWindowOptions& options, const SceneScale& scene,
                      const WindowFit& fit = {});

/// Peaks of the decision function of one scale as hypotheses; `decision` receives the function itself.
std::vector<WindowHypothesis> scanAtScale(const WindowScanner& scanner, const cv::Mat& upright, double scale,
                                          const SlidingWindowOptions& options, const SceneScale& scene,
                                          cv::Mat& decision);

}  // namespace eyrie
