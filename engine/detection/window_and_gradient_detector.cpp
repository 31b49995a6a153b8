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

namespace {

/// Adds the layers of a search area's middle, laid into the whole area.
void addWidened(DetectionTrace& trace, const DetectionTrace& inner, cv::Size whole) {
    for (const DetectionTrace::Layer& layer : inner.layers) {
        if (layer.name == "raw") continue;
        const cv::Point offset((whole.width - layer.image.cols) / 2, (whole.height - layer.image.rows) / 2);
        cv::Mat image(whole, layer.image.type(), cv::Scalar(0));
        layer.image.copyTo(image(cv::Rect(offset, layer.image.size())));
        std::vector<cv::Rect2d> boxes = layer.boxes;
        for (cv::Rect2d& box : boxes) box += cv::Point2d(offset);
        trace.layers.push_back({layer.name, image, std::move(boxes)});
    }
}

class BothPrepared : public PreparedArea {
 public:
    std::size_t bytes() const override {
        return sizeof *this + (window ? window->bytes() : 0) + (gradient ? gradient->bytes() : 0);
    }
    std::unique_ptr<const PreparedArea> window;
    std::unique_ptr<const PreparedArea> gradient;
};

}  // namespace

std::unique_ptr<const PreparedArea> WindowAndGradientDetector::prepare(const MotionRoi& roi) const {
    auto both = std::make_unique<BothPrepared>();
    both->window = window_->prepare(roi);
    both->gradient = gradient_->prepare(narrowed(roi, context_));
    return both;
}

std::vector<Detection> WindowAndGradientDetector::decide(const MotionRoi& roi, const PreparedArea* prepared) const {
    const auto* both = dynamic_cast<const BothPrepared*>(prepared);
    if (both == nullptr) return detect(roi);
    return joined(window_->decide(roi, both->window.get()),
                  gradient_->decide(narrowed(roi, context_), both->gradient.get()));
}

std::vector<Detection> WindowAndGradientDetector::detect(const MotionRoi& roi, DetectionTrace* trace) const {
    std::vector<Detection> windows = window_->detect(roi, trace);
    DetectionTrace inner;
    std::vector<Detection> segments = gradient_->detect(narrowed(roi, context_), trace != nullptr ? &inner : nullptr);
    if (trace != nullptr) addWidened(*trace, inner, roi.image.size());
    return joined(std::move(windows), std::move(segments));
}

std::vector<Detection> WindowAndGradientDetector::joined(std::vector<Detection> found,
                                                         std::vector<Detection> segments) const {
    std::erase_if(found, [&](const Detection& d) { return !d.complete || d.score < options_.sure_decision; });
    const auto windows = static_cast<std::ptrdiff_t>(found.size());
    for (Detection& segment : segments) {
        const double area = segment.box.area();
        const bool covered = std::any_of(found.begin(), found.begin() + windows, [&](const Detection& window) {
            return intersectionArea(window.box, segment.box) > options_.most_covered * area;
        });
        if (!covered) found.push_back(std::move(segment));
    }
    return found;
}

}  // namespace eyrie
