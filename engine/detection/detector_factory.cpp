#include "detection/detector_factory.h"

#include "detection/detector_table.h"
#include "detection/scaled_detectors.h"

namespace eyrie {

std::unique_ptr<Detector> makeDetector(const DetectionOptions& options, const SceneScale& scale) {
    return std::make_unique<ScaledDetectors>(
        scale, [options, make = kindOf(options.method).make](const SceneScale& here) { return make(options, here); });
}

}  // namespace eyrie
