#include "detection/sliding_window/window_and_gradient_detector.h"

#include <algorithm>

#include "detection/roi_cutter.h"
#include "imaging/upright_patch.h"

namespace eyrie {

void WindowAndGradientOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::detection);
    const ParameterDeclarer deciding = declare.decisionOnly();
    deciding.real("window_and_gradient.sure_decision", sure_decision, -1000, 1000,
                  {"",
                   "Windows with at least this decision value are vehicles; elsewhere gradients decide. Larger: more "
                   "gradients.",
                   ""});
    deciding.real("window_and_gradient.most_covered", most_covered, 0, 1,
                  {"", "Segments with more than this share inside such a window belong to its vehicle.", ""});
    declare.real(
        "window_and_gradient.rejection_margin", rejection_margin, -100, 1000,
        {"",
         "Windows are given up as soon as their sum lies this far below that of any training vehicle. Smaller: "
         "faster, may lose unusual vehicles. 0.5 lost none of 11,500 sure windows of six clips.",
         ""});
}

namespace {

/// Adds the layers of a search area's middle, laid into the whole area.
void addWidened(DetectionTrace& trace, const DetectionTrace& inner, cv::Size whole) {
    cv::Point2d offset_of_inner(0, 0);
    for (const DetectionTrace::Layer& layer : inner.layers) {
        if (layer.kind == TraceLayer::raw) continue;
        const cv::Point offset((whole.width - layer.image.cols) / 2, (whole.height - layer.image.rows) / 2);
        offset_of_inner = offset;
        cv::Mat image(whole, layer.image.type(), cv::Scalar(0));
        layer.image.copyTo(image(cv::Rect(offset, layer.image.size())));
        std::vector<cv::Rect2d> boxes = layer.boxes;
        for (cv::Rect2d& box : boxes) box += cv::Point2d(offset);
        trace.layers.push_back({layer.kind, image, std::move(boxes), layer.scale});
    }
    for (DetectionTrace::Check check : inner.checks) {
        if (check.box.area() > 0) check.box += offset_of_inner;
        trace.checks.push_back(std::move(check));
    }
}

/// A detection of this search area by its edges in it.
cv::Rect2d boxInRoi(const cv::Matx23d& image_from_roi, const OrientedBox& box) {
    const cv::Point2d centre = toPatch(image_from_roi, box.centre);
    return {centre.x - box.width / 2, centre.y - box.length / 2, box.width, box.length};
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
    return joined(roi, window_->decide(roi, both->window.get()),
                  gradient_->decide(narrowed(roi, context_), both->gradient.get()));
}

std::vector<Detection> WindowAndGradientDetector::detect(const MotionRoi& roi, DetectionTrace* trace) const {
    std::vector<Detection> windows = window_->detect(roi, trace);
    if (trace != nullptr) {
        for (const Detection& window : windows) {
            if (!window.complete) continue;
            trace->checks.push_back({"decision value of a window that stands by itself",
                                     "window_and_gradient.sure_decision", window.score, options_.sure_decision, false,
                                     window.score >= options_.sure_decision, boxInRoi(roi.image_from_roi, window.box)});
        }
    }
    DetectionTrace inner;
    std::vector<Detection> segments = gradient_->detect(narrowed(roi, context_), trace != nullptr ? &inner : nullptr);
    if (trace != nullptr) addWidened(*trace, inner, roi.image.size());
    return joined(roi, std::move(windows), std::move(segments), trace);
}

std::vector<Detection> WindowAndGradientDetector::joined(const MotionRoi& roi, std::vector<Detection> found,
                                                         std::vector<Detection> segments, DetectionTrace* trace) const {
    std::erase_if(found, [&](const Detection& d) { return !d.complete || d.score < options_.sure_decision; });
    const auto windows = static_cast<std::ptrdiff_t>(found.size());
    for (Detection& segment : segments) {
        const double area = segment.box.area();
        double covered_area = 0;
        for (auto window = found.begin(); window != found.begin() + windows; ++window)
            covered_area = std::max(covered_area, intersectionArea(window->box, segment.box));
        const bool covered = covered_area > options_.most_covered * area;
        if (trace != nullptr && windows > 0) {
            trace->checks.push_back({"share of a segment inside a sure window", "window_and_gradient.most_covered",
                                     covered_area / std::max(area, 1e-9), options_.most_covered, true, !covered,
                                     boxInRoi(roi.image_from_roi, segment.box)});
        }
        if (!covered) found.push_back(std::move(segment));
    }
    return found;
}

}  // namespace eyrie
