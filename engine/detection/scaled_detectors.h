#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "core/values/scene_scale.h"
#include "detection/detector.h"

namespace eyrie {

/// One detector for each of a few scales: in an oblique view, and where the camera zooms, a search area goes to the one
/// whose scale is next to that at its place, or at the picture's nearest place.
class ScaledDetectors : public Detector {
 public:
    using Make = std::function<std::unique_ptr<Detector>(const SceneScale& here)>;

    /// `scale`: of the first frame. Makes those that its picture needs, whose middle is the slope's centre; others when
    /// they are first asked for. Throws what `make` throws.
    ScaledDetectors(const SceneScale& scale, Make make);

    std::vector<Detection> detect(const MotionRoi& roi, DetectionTrace* trace = nullptr) const override;
    std::unique_ptr<const PreparedArea> prepare(const MotionRoi& roi) const override;
    std::vector<Detection> decide(const MotionRoi& roi, const PreparedArea* prepared) const override;
    /// That of all of them.
    const VehicleModel* model() const override { return detectorAt(0).model(); }

 private:
    /// Step 0 is the scale at the centre of the first frame.
    int stepAt(cv::Point2d place, double zoom) const;
    const Detector& detectorAt(int step) const;
    const Detector& detectorFor(const MotionRoi& roi) const { return detectorAt(stepAt(roi.box.centre, roi.zoom)); }

    SceneScale scale_;
    Make make_;
    mutable std::mutex mutex_;
    mutable std::map<int, std::unique_ptr<Detector>> detectors_;  ///< by step
};

}  // namespace eyrie
