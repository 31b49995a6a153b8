#include "detection/detector_factory.h"

#include "detection/detector_table.h"
#include "detection/scaled_detectors.h"

namespace eyrie {

std::unique_ptr<Detector> makeDetector(const DetectionOptions& options, const SceneScale& scale) {
    const auto make = kindOf(options.method).make;
    if (scale.slope.isFlat()) return make(options, scale);
    return std::make_unique<ScaledDetectors>(scale, [&](const SceneScale& here) { return make(options, here); });
}

}  // namespace eyrie
