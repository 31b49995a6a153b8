#pragma once

#include <vector>

#include "core/values/detection.h"
#include "core/values/frame.h"
#include "core/values/scene_scale.h"
#include "detection/sliding_window/sliding_window_options.h"
#include "learning/models/window_scanner.h"

namespace eyrie {

/// How much detections look like vehicles to the classifier, wherever their boxes come from. The search takes for
/// vehicles only what it is sure of; over a track's life also what it half believes tells vehicles that are dark, hazy
/// or seen from an unusual side from relief and noise. Immutable: may be used by several threads.
class BoxClassifier {
 public:
    /// `model`: that of the detector in use (Detector::model()).
    BoxClassifier(VehicleModel model, const SlidingWindowOptions& options, const SceneScale& scale);

    /// The highest decision value of a window that is laid over the box in a CV_8UC1 image, 0 being the classifier's
    /// border. The window is fitted to a size between that of the box and that of a car; it is moved by a sixth of it
    /// and made longer and shorter by a third. NaN where the box's centre lies beyond the image. `zoom`: that of the
    /// frame, Registration::zoom.
    double at(const cv::Mat& gray, const OrientedBox& box, double zoom = 1) const;

    /// Whether it looks at this frame: at some four a second.
    bool looksAt(FrameIndex frame) const { return frame % every_ == 0; }
    /// Gives the detections that were kept their decision, in frames that it looks at.
    void judge(std::vector<Detection>& detections, const Frame& frame, double zoom) const;

 private:
    WindowScanner scanner_;
    SlidingWindowOptions options_;
    SceneScale scale_;
    FrameIndex every_;  ///< frames, ≥ 1
};

}  // namespace eyrie
