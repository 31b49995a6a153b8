#pragma once

#include <limits>
#include <vector>

#include "core/values/detection.h"

namespace eyrie {

/// A detection that was kept, as the classifier sees it.
struct ClassifiedBox {
    OrientedBox box;
    bool whole = false;  ///< it was found as a whole vehicle; see Detection::complete
    double decision = std::numeric_limits<double>::quiet_NaN();  ///< see Detection::decision
};

/// Those detections that were kept and of which the classifier says something.
std::vector<ClassifiedBox> classifiedOf(const std::vector<Detection>& detections);

}  // namespace eyrie
