#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/values/scene_scale.h"
#include "detection/detector.h"

namespace eyrie {

/// One detector for each of a few scales of an oblique view: a search area goes to the one whose scale is next to that
/// at its place, or at the picture's nearest place.
class ScaledDetectors : public Detector {
 public:
    using Make = std::function<std::unique_ptr<Detector>(const SceneScale& here)>;

    /// Makes those that a picture needs whose middle is the slope's centre. Throws what `make` throws.
    ScaledDetectors(const SceneScale& scale, const Make& make);

    std::vector<Detection> detect(const MotionRoi& roi, DetectionTrace* trace = nullptr) const override;
    std::unique_ptr<const PreparedArea> prepare(const MotionRoi& roi) const override;
    std::vector<Detection> decide(const MotionRoi& roi, const PreparedArea* prepared) const override;
    /// That of all of them.
    const VehicleModel* model() const override { return detectors_.front()->model(); }

 private:
    int stepAt(cv::Point2d place) const;
    const Detector& detectorFor(const MotionRoi& roi) const;

    SceneScale scale_;
    int first_ = 0;  ///< step of the first detector, ≤ 0; step 0 is the scale at the centre
    std::vector<std::unique_ptr<Detector>> detectors_;
};

}  // namespace eyrie
