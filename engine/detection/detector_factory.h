#pragma once

#include <memory>

#include "core/values/scene_scale.h"
#include "detection/detection_options.h"
#include "detection/detector.h"

namespace eyrie {

/// The detector that the options name. Throws Error(input) when it needs a model file that is missing or damaged.
std::unique_ptr<Detector> makeDetector(const DetectionOptions& options, const SceneScale& scale);

}  // namespace eyrie
