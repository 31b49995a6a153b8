#pragma once

#include "core/values/scene_scale.h"
#include "detection/detector.h"
#include "detection/sliding_window/sliding_window_options.h"
#include "detection/sliding_window/window_hypotheses.h"

namespace eyrie {

/// Object detection by a local sliding window (Teutsch §5.4.3, fig. 5.21): the search area at several scales, a
/// decision value for every window, two non-maximum suppressions. The score of a detection is its decision value.
class SlidingWindowDetector : public Detector {
 public:
    /// `model`: the classifier to use; `cluster_margin`: margin of the cluster's box where that is delivered
    /// instead.
    SlidingWindowDetector(VehicleModel model, const SlidingWindowOptions& options, const SceneScale& scale,
                          double cluster_margin);

    /// Trace layers: raw, the decision of every scale (decision values at the windows' centres), first and second
    /// suppression (raw, with the boxes left).
    std::vector<Detection> detect(const MotionRoi& roi, DetectionTrace* trace = nullptr) const override;

    /// Every peak of the decision function, however low.
    std::unique_ptr<const PreparedArea> prepare(const MotionRoi& roi) const override;
    std::vector<Detection> decide(const MotionRoi& roi, const PreparedArea* prepared) const override;
    const VehicleModel* model() const override { return &scanner_.model(); }

 private:
    bool accepted(const MotionRoi& roi, const WindowHypothesis& found) const;
    std::vector<Detection> detectionsOf(const MotionRoi& roi, const std::vector<WindowHypothesis>& hypotheses) const;

    WindowScanner scanner_;
    SlidingWindowOptions options_;
    SceneScale scale_;
    double cluster_margin_;
};

/// Loads the model that the options name. Throws Error(input) when it is missing or damaged.
std::unique_ptr<Detector> makeSlidingWindowDetector(const SlidingWindowOptions& options, const SceneScale& scale,
                                                    double cluster_margin);

}  // namespace eyrie
