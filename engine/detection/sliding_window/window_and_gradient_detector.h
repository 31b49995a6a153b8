#pragma once

#include <memory>

#include "core/parameter.h"
#include "detection/detector.h"

namespace eyrie {

/// Parameters of the sliding window and gradients together.
struct WindowAndGradientOptions {
    double sure_decision = 6;    ///< windows from this decision value on stand by themselves
    double most_covered = 0.25;  ///< share of a segment that may lie in a sure window
    /// Of the early rejection (see WindowScanner), in place of the sliding window's own: only sure windows are asked
    /// for.
    double rejection_margin = 0.5;

    void describe(ParameterVisitor& visitor);
};

/// The sliding window where it is sure, gradient based segmentation for what it leaves over: the window knows where a
/// vehicle ends, but only in the views that it was trained on; segmentation takes whatever moves.
class WindowAndGradientDetector : public Detector {
 public:
    /// `context`: px by which search areas are wider for the windows than segmentation needs.
    WindowAndGradientDetector(std::unique_ptr<Detector> window, std::unique_ptr<Detector> gradient,
                              const WindowAndGradientOptions& options, int context)
        : window_(std::move(window)), gradient_(std::move(gradient)), options_(options), context_(context) {}

    /// Trace layers: those of the sliding window, then those of the gradients.
    std::vector<Detection> detect(const MotionRoi& roi, DetectionTrace* trace = nullptr) const override;

    std::unique_ptr<const PreparedArea> prepare(const MotionRoi& roi) const override;
    std::vector<Detection> decide(const MotionRoi& roi, const PreparedArea* prepared) const override;
    const VehicleModel* model() const override { return window_->model(); }

 private:
    std::vector<Detection> joined(const MotionRoi& roi, std::vector<Detection> found, std::vector<Detection> segments,
                                  DetectionTrace* trace = nullptr) const;

    std::unique_ptr<Detector> window_;
    std::unique_ptr<Detector> gradient_;
    WindowAndGradientOptions options_;
    int context_;
};

}  // namespace eyrie
