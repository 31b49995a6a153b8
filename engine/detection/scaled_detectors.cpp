#include "detection/scaled_detectors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace eyrie {
namespace {

constexpr double kScaleStep = 1.1;  ///< between neighbouring detectors: vehicles differ by more

}  // namespace

ScaledDetectors::ScaledDetectors(const SceneScale& scale, Make make) : scale_(scale), make_(std::move(make)) {
    detectorOf(0);
}

const Detector& ScaledDetectors::detectorOf(int step) const {
    const std::scoped_lock lock(mutex_);
    std::unique_ptr<Detector>& detector = detectors_[static_cast<std::size_t>(step + kBelow)];
    if (!detector) {
        SceneScale here = scale_;
        here.slope = {};
        here.gsd_m_per_px /= std::pow(kScaleStep, step);
        detector = make_(here);
    }
    return *detector;
}

const Detector& ScaledDetectors::detectorFor(const MotionRoi& roi) const {
    const double steps = std::log(scale_.slope.factorAt(roi.box.centre)) / std::log(kScaleStep);
    return detectorOf(std::clamp(static_cast<int>(std::lround(steps)), -kBelow, kAbove));
}

std::vector<Detection> ScaledDetectors::detect(const MotionRoi& roi, DetectionTrace* trace) const {
    return detectorFor(roi).detect(roi, trace);
}

std::unique_ptr<const PreparedArea> ScaledDetectors::prepare(const MotionRoi& roi) const {
    return detectorFor(roi).prepare(roi);
}

std::vector<Detection> ScaledDetectors::decide(const MotionRoi& roi, const PreparedArea* prepared) const {
    return detectorFor(roi).decide(roi, prepared);
}

}  // namespace eyrie
