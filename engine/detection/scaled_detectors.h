#pragma once

#include <array>
#include <functional>
#include <memory>
#include <mutex>

#include "core/values/scene_scale.h"
#include "detection/detector.h"

namespace eyrie {

/// One detector for each of a few scales of an oblique view: a search area goes to the one whose scale is next to that
/// at its place. Each is made when it is first needed.
class ScaledDetectors : public Detector {
 public:
    using Make = std::function<std::unique_ptr<Detector>(const SceneScale& here)>;

    /// Makes the detector of the slope's centre at once, so that what `make` throws is thrown here.
    ScaledDetectors(const SceneScale& scale, Make make);

    std::vector<Detection> detect(const MotionRoi& roi, DetectionTrace* trace = nullptr) const override;
    std::unique_ptr<const PreparedArea> prepare(const MotionRoi& roi) const override;
    std::vector<Detection> decide(const MotionRoi& roi, const PreparedArea* prepared) const override;

 private:
    static constexpr int kBelow = 18;  ///< steps down to ScaleSlope::kLeast …
    static constexpr int kAbove = 15;  ///< … and up to ScaleSlope::kMost

    const Detector& detectorFor(const MotionRoi& roi) const;
    const Detector& detectorOf(int step) const;

    SceneScale scale_;
    Make make_;
    mutable std::mutex mutex_;
    mutable std::array<std::unique_ptr<Detector>, kBelow + 1 + kAbove> detectors_;
};

}  // namespace eyrie
