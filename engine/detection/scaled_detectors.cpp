#include "detection/scaled_detectors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace eyrie {
namespace {

constexpr double kScaleStep = 1.1;  ///< between neighbouring detectors: vehicles differ by more

}  // namespace

ScaledDetectors::ScaledDetectors(const SceneScale& scale, Make make) : scale_(scale), make_(std::move(make)) {
    int first = 0;
    int last = 0;
    // Linear over the picture: the extremes lie at its corners.
    for (const double x : {0.0, 2 * scale.slope.centre_x}) {
        for (const double y : {0.0, 2 * scale.slope.centre_y}) {
            first = std::min(first, stepAt({x, y}, 1));
            last = std::max(last, stepAt({x, y}, 1));
        }
    }
    for (int step = first; step <= last; ++step) detectorAt(step);
}

int ScaledDetectors::stepAt(cv::Point2d place, double zoom) const {
    const cv::Point2d farthest = 2 * scale_.slope.centre();
    if (!scale_.slope.isFlat()) place = {std::clamp(place.x, 0.0, farthest.x), std::clamp(place.y, 0.0, farthest.y)};
    const double larger = scale_.gsd_m_per_px / scale_.zoomed(zoom).at(place).gsd_m_per_px;
    return static_cast<int>(std::lround(std::log(larger) / std::log(kScaleStep)));
}

const Detector& ScaledDetectors::detectorAt(int step) const {
    const std::scoped_lock lock(mutex_);
    std::unique_ptr<Detector>& detector = detectors_[step];
    if (!detector) {
        SceneScale here = scale_;
        here.slope = {};
        here.gsd_m_per_px /= std::pow(kScaleStep, step);
        detector = make_(here);
    }
    return *detector;
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
