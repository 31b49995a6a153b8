#pragma once

#include <memory>

#include "core/values/scene_scale.h"
#include "detection/detection_options.h"
#include "detection/detector.h"

namespace eyrie {

/// What there is to know of a detector without making one; a row of the table of them.
struct DetectorKind {
    const char* name;      ///< the word used in parameters and tables, e.g. "relative_connectivity"
    bool through_windows;  ///< a trained classifier takes part
    bool whole_vehicles;   ///< its boxes are those of whole vehicles: duplicates are suppressed, not fused
    void (*describe)(DetectionOptions&, ParameterVisitor&);  ///< its own parameters
    void (*set_as_in_thesis)(DetectionOptions&);             ///< their values in the text
    std::unique_ptr<Detector> (*make)(const DetectionOptions&, const SceneScale&);
};
const DetectorKind& kindOf(DetectionMethod method);

}  // namespace eyrie
