#include "detection/window_and_gradient_detector.h"

#include <algorithm>

#include "detection/roi_cutter.h"

namespace eyrie {

void WindowAndGradientOptions::describe(ParameterVisitor& visitor) {
    visitor.real("window_and_gradient.sure_decision", sure_decision, -1000, 1000,
                 {"",
                  "Windows with at least this decision value are vehicles; elsewhere gradients decide. Larger: more "
                  "gradients.",
                  ""});
    visitor.real("window_and_gradient.most_covered", most_covered, 0, 1,
                 {"", "Segments with more than this share inside such a window belong to its vehicle.", ""});
}

std::vector<Detection> WindowAndGradientDetector::detect(const MotionRoi& roi, DetectionTrace* trace) const {
    std::vector<Detection> found = window_->detect(roi, trace);
    std::erase_if(found, [&](const Detection& d) { return !d.complete || d.score < options_.sure_decision; });
    const auto windows = static_cast<std::ptrdiff_t>(found.size());
    for (Detection& segment : gradient_->detect(narrowed(roi, context_), trace)) {
        const double area = segment.box.area();
        const bool covered = std::any_of(found.begin(), found.begin() + windows, [&](const Detection& window) {
            return intersectionArea(window.box, segment.box) > options_.most_covered * area;
        });
        if (!covered) found.push_back(std::move(segment));
    }
    return found;
}

}  // namespace eyrie
