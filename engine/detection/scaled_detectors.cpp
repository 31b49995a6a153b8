#include "detection/scaled_detectors.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

constexpr double kScaleStep = 1.1;  ///< between neighbouring detectors: vehicles differ by more

}  // namespace

ScaledDetectors::ScaledDetectors(const SceneScale& scale, const Make& make) : scale_(scale) {
    int last = 0;
    // Linear over the picture: the extremes lie at its corners.
    for (const double x : {0.0, 2 * scale.slope.centre_x}) {
        for (const double y : {0.0, 2 * scale.slope.centre_y}) {
            first_ = std::min(first_, stepAt({x, y}));
            last = std::max(last, stepAt({x, y}));
        }
    }
    for (int step = first_; step <= last; ++step) {
        SceneScale here = scale;
        here.slope = {};
        here.gsd_m_per_px /= std::pow(kScaleStep, step);
        detectors_.push_back(make(here));
    }
}

int ScaledDetectors::stepAt(cv::Point2d place) const {
    return static_cast<int>(std::lround(std::log(scale_.slope.factorAt(place)) / std::log(kScaleStep)));
}

const Detector& ScaledDetectors::detectorFor(const MotionRoi& roi) const {
    const int last = static_cast<int>(detectors_.size()) - 1;
    return *detectors_[static_cast<std::size_t>(std::clamp(stepAt(roi.box.centre) - first_, 0, last))];
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
