#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/values/detection.h"
#include "core/values/scene_scale.h"
#include "detection/sliding_window/sliding_window_options.h"
#include "learning/models/window_scanner.h"

namespace eyrie {

/// The sliding window over a whole image, without any knowledge of motion: what the local one is compared with (Teutsch
/// §5.4.3). The image is turned into `orientations` directions between 0 and 180°, as front and rear of a vehicle are
/// not told apart; each is scanned at all scales, and of overlapping boxes of all directions the surest stays. Headings
/// are in (−90°, 90°]; velocities are 0 and there is no cluster. `gray` is CV_8UC1.
std::vector<Detection> globalSlidingWindow(const WindowScanner& scanner, const cv::Mat& gray,
                                           const SlidingWindowOptions& options, const SceneScale& scale,
                                           int orientations = 12);

}  // namespace eyrie
