#include "detection/segmenters/gradient_segmenter.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "detection/motion_cluster_detector.h"
#include "imaging/gradients.h"
#include "imaging/region_boxes.h"
#include "imaging/thresholds.h"

namespace eyrie {
namespace {

LbpGradientOptions lbpOf(const GradientOptions& options) {
    LbpGradientOptions lbp;
    lbp.threshold = options.lbp_threshold;
    lbp.radii.clear();
    const int last = std::max(options.lbp_radius_min, options.lbp_radius_max);
    for (int radius = options.lbp_radius_min; radius <= last; ++radius) lbp.radii.push_back(radius);
    return lbp;
}

/// A closing with a flat square is the same before and after thresholding, so it need not be done for every threshold.
class ClosedGradient : public PreparedArea {
 public:
    std::size_t bytes() const override {
        return closed.total() * sizeof(float) + ranked.size() * sizeof(float) + sizeof *this;
    }
    cv::Mat closed;             ///< CV_32FC1; below 0 outside the video
    std::vector<float> ranked;  ///< positive gradients of the quantile area, descending
    std::size_t counted = 0;    ///< pixels of the quantile area
};

}  // namespace

GradientSegmenter::GradientSegmenter(const GradientOptions& options, const SceneScale& scale, double cluster_margin)
    : options_(options),
      lbp_(lbpOf(options)),
      component_boxes_(options, scale),
      quantile_margin_(std::max(1.0, scale.px(options.quantile_margin_m))),
      cluster_margin_(cluster_margin) {}

cv::Mat GradientSegmenter::gradientOf(const cv::Mat& gray) const {
    cv::Mat gradient;
    switch (options_.method) {
        case GradientMethod::lbp:
            lbpGradient(gray, lbp_, gradient);
            break;
        case GradientMethod::simple:
            simpleGradient(gray, gradient);
            break;
        case GradientMethod::canny:
            cannyGradient(gray, options_.canny_variance, gradient);
            break;
        case GradientMethod::morphological:
            morphologicalGradient(gray, gradient);
            break;
    }
    return gradient;
}

cv::Mat GradientSegmenter::quantileMask(const MotionRoi& roi) const {
    if (options_.quantile_area == QuantileArea::roi || roi.vectors.empty()) return roi.inside;
    cv::Mat mask = cv::Mat::zeros(roi.image.size(), CV_8UC1);
    if (options_.quantile_area == QuantileArea::box) {
        const cv::Rect2d box = grown(boundsOf(roi.vectors), quantile_margin_, quantile_margin_);
        const cv::Point top_left(cvRound(box.x), cvRound(box.y));
        const cv::Point bottom_right(cvRound(box.x + box.width), cvRound(box.y + box.height));
        const cv::Rect part = cv::Rect(top_left, bottom_right + cv::Point(1, 1)) & cv::Rect({0, 0}, roi.image.size());
        mask(part).setTo(255);
    } else {
        for (const cv::Point2f& vector : roi.vectors) {
            cv::circle(mask, {cvRound(vector.x), cvRound(vector.y)}, cvRound(quantile_margin_), 255, cv::FILLED);
        }
    }
    return mask & roi.inside;
}

std::vector<cv::Rect2d> GradientSegmenter::segment(const MotionRoi& roi, DetectionTrace* trace) const {
    const cv::Mat gradient = gradientOf(roi.image);
    if (trace != nullptr) {
        trace->add(TraceLayer::gradient, gradient);
        if (options_.method == GradientMethod::lbp) trace->add(TraceLayer::lbp_mask, gradient > 0);
    }
    const cv::Mat quantile_mask = quantileMask(roi);
    if (trace != nullptr) trace->add(TraceLayer::quantile_area, quantile_mask);
    const auto threshold = quantileThreshold(gradient, quantile_mask, options_.effectiveQuantile());
    if (!threshold) return {};
    cv::Mat binary;
    binarise(gradient, roi.inside, *threshold, binary);
    cv::Mat closed;
    closeGaps(binary, closed);
    cv::Mat labels;
    const std::vector<Region> regions = findRegions(closed, options_.min_box_area, labels);
    std::vector<cv::Rect2d> boxes = component_boxes_.select(regions, labels, roi.vectors, trace);
    if (trace != nullptr) {
        trace->add(TraceLayer::binary, binary);
        trace->add(TraceLayer::closed, closed);
        cv::Mat components;
        labels.convertTo(components, CV_8U);
        trace->add(TraceLayer::components, components, boxes);
    }
    return boxes;
}

std::unique_ptr<const PreparedArea> GradientSegmenter::prepare(const MotionRoi& roi) const {
    if (roi.image.empty()) return nullptr;
    auto prepared = std::make_unique<ClosedGradient>();
    cv::Mat gradient = gradientOf(roi.image);
    RankedValues ranked = rankedValues(gradient, quantileMask(roi));
    prepared->ranked = std::move(ranked.positive);
    prepared->counted = ranked.counted;
    gradient.setTo(-1, roi.inside == 0);
    closeGaps(gradient, prepared->closed);
    return prepared;
}

std::vector<Detection> GradientSegmenter::decide(const MotionRoi& roi, const PreparedArea* prepared) const {
    const auto* gradient = dynamic_cast<const ClosedGradient*>(prepared);
    if (gradient == nullptr) return detect(roi);
    const auto threshold = quantileThreshold(gradient->ranked, gradient->counted, options_.effectiveQuantile());
    if (!threshold) return detectionsOf(roi, {});
    cv::Mat labels;
    const std::vector<Region> regions =
        findRegions(gradient->closed >= static_cast<double>(*threshold), options_.min_box_area, labels);
    return detectionsOf(roi, component_boxes_.select(regions, labels, roi.vectors));
}

std::vector<Detection> GradientSegmenter::detect(const MotionRoi& roi, DetectionTrace* trace) const {
    if (trace != nullptr) trace->add(TraceLayer::raw, roi.image);
    if (roi.image.empty()) return {};
    return detectionsOf(roi, segment(roi, trace), trace);
}

std::vector<Detection> GradientSegmenter::detectionsOf(const MotionRoi& roi, const std::vector<cv::Rect2d>& boxes,
                                                       DetectionTrace* trace) const {
    if (options_.fall_back && !component_boxes_.explain(boxes, roi.vectors, trace))
        return clusterDetection(roi, cluster_margin_);
    return detectionsIn(roi, boxes);
}

}  // namespace eyrie
