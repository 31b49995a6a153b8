#include "detection/segmenters/mask_segmenter.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "detection/motion_cluster_detector.h"
#include "imaging/region_boxes.h"

namespace eyrie {
namespace {

constexpr int kSmallestMaskSide = 3;  // px; nothing has an inside and an outside in less

/// Only the LBP gradient reaches beyond edges, so only there boxes are to be corrected.
GradientOptions withoutReach(GradientOptions options) {
    options.method = GradientMethod::simple;
    return options;
}

}  // namespace

void addLayer(DetectionTrace* trace, TraceLayer kind, const cv::Mat& image) {
    if (trace == nullptr) return;
    if (image.type() == CV_8UC1 || image.type() == CV_32FC1) {
        trace->add(kind, image);
        return;
    }
    cv::Mat shown;
    image.convertTo(shown, CV_32F);
    trace->add(kind, shown);
}

cv::Mat discElement(double diameter_px) {
    const int side = std::max(0, cvRound((diameter_px - 1) / 2)) * 2 + 1;
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side});
}

double otsuWithin(const cv::Mat& image, const cv::Mat& mask) {
    CV_Assert(image.empty() || (image.type() == CV_8UC1 && mask.type() == CV_8UC1 && mask.size() == image.size()));
    std::vector<uchar> values;
    values.reserve(image.total());
    for (int y = 0; y < image.rows; ++y) {
        const uchar* value = image.ptr<uchar>(y);
        const uchar* in = mask.ptr<uchar>(y);
        for (int x = 0; x < image.cols; ++x) {
            if (in[x] != 0) values.push_back(value[x]);
        }
    }
    if (values.empty()) return 255;
    cv::Mat unused;
    return cv::threshold(values, unused, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
}

MaskSegmenter::MaskSegmenter(const GradientOptions& components, const SceneScale& scale, double cluster_margin)
    : components_(withoutReach(components)), component_boxes_(components_, scale), cluster_margin_(cluster_margin) {}

std::vector<cv::Rect2d> MaskSegmenter::segment(const MotionRoi& roi, DetectionTrace* trace) const {
    if (std::min(roi.image.cols, roi.image.rows) < kSmallestMaskSide) return {};
    const cv::Mat pixels = objectPixels(roi, trace) & roi.inside;
    cv::Mat labels;
    const std::vector<Region> regions = findRegions(pixels, components_.min_box_area, labels);
    std::vector<cv::Rect2d> boxes = component_boxes_.select(regions, labels, roi.vectors, trace);
    if (trace != nullptr) {
        cv::Mat components;
        labels.convertTo(components, CV_8U);
        trace->add(TraceLayer::components, components, boxes);
    }
    return boxes;
}

std::vector<Detection> MaskSegmenter::detect(const MotionRoi& roi, DetectionTrace* trace) const {
    if (trace != nullptr) trace->add(TraceLayer::raw, roi.image);
    if (roi.image.empty()) return {};
    const std::vector<cv::Rect2d> boxes = segment(roi, trace);
    if (components_.fall_back && !component_boxes_.explain(boxes, roi.vectors, trace))
        return clusterDetection(roi, cluster_margin_);
    return detectionsIn(roi, boxes);
}

}  // namespace eyrie
