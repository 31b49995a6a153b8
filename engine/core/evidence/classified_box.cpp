#include "core/evidence/classified_box.h"

#include <cmath>

namespace eyrie {

std::vector<ClassifiedBox> classifiedOf(const std::vector<Detection>& detections) {
    std::vector<ClassifiedBox> boxes;
    for (const Detection& detection : detections) {
        if (detection.rejection != Rejection::none) continue;
        if (detection.complete || !std::isnan(detection.decision))
            boxes.push_back({detection.box, detection.complete, detection.decision});
    }
    return boxes;
}

}  // namespace eyrie
