#include "detection/segmenters/tophat_otsu_segmenter.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace eyrie {
namespace {

constexpr double kSmallestElement = 3;  // px

cv::Mat elementOf(const SceneScale& scale, double metres) {
    return discElement(std::max(kSmallestElement, scale.px(metres)));
}

}  // namespace

TophatOtsuOptions TophatOtsuOptions::thesis() {
    TophatOtsuOptions options;
    options.min_contrast = 0;
    options.joining_m = 0;
    return options;
}

void TophatOtsuOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::detection);
    declare.real("tophat_otsu.element", element_m, 0.1, 100,
                 {"m",
                  "Diameter of the structuring element. Brighter and darker areas that are narrower than this in some "
                  "direction are found.",
                  "Teutsch §7.4.1"});
    declare.real("tophat_otsu.smoothing", smoothing_m, 0, 10,
                 {"m", "Diameter of the closing and opening that take away road markings first; at least 3 px.",
                  "Teutsch §7.4.1"});
    declare.real("tophat_otsu.min_contrast", min_contrast, 0, 255,
                 {"grey", "Otsu's threshold is raised to at least this.", ""});
    declare.real("tophat_otsu.joining", joining_m, 0, 10,
                 {"m", "Diameter of the closing that joins what was found; at least 3 px. 0: none.", ""});
}

TophatOtsuSegmenter::TophatOtsuSegmenter(const TophatOtsuOptions& options, const GradientOptions& components,
                                         const SceneScale& scale, double cluster_margin)
    : MaskSegmenter(components, scale, cluster_margin),
      min_contrast_(options.min_contrast),
      element_(elementOf(scale, options.element_m)),
      smoothing_(elementOf(scale, options.smoothing_m)),
      joining_(options.joining_m > 0 ? elementOf(scale, options.joining_m) : cv::Mat()) {}

cv::Mat TophatOtsuSegmenter::objectPixels(const MotionRoi& roi, DetectionTrace* trace) const {
    cv::Mat smooth;
    cv::morphologyEx(roi.image, smooth, cv::MORPH_CLOSE, smoothing_);
    cv::morphologyEx(smooth, smooth, cv::MORPH_OPEN, smoothing_);
    cv::Mat white;
    cv::Mat black;
    cv::morphologyEx(smooth, white, cv::MORPH_TOPHAT, element_);
    cv::morphologyEx(smooth, black, cv::MORPH_BLACKHAT, element_);
    const cv::Mat tophat = cv::max(white, black);
    const double threshold = std::max(otsuWithin(tophat, roi.inside), min_contrast_);
    const cv::Mat binary = (tophat > threshold) & roi.inside;
    cv::Mat closed;
    if (joining_.empty()) {
        closed = binary.clone();
    } else {
        cv::morphologyEx(binary, closed, cv::MORPH_CLOSE, joining_);
    }
    addLayer(trace, TraceLayer::smoothed, smooth);
    addLayer(trace, TraceLayer::white_tophat, white);
    addLayer(trace, TraceLayer::black_tophat, black);
    addLayer(trace, TraceLayer::binary, binary);
    addLayer(trace, TraceLayer::closed, closed);
    return closed;
}

}  // namespace eyrie
