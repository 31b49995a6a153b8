#include "detection/detector_factory.h"

#include <string>

#include "core/error.h"
#include "detection/motion_cluster_detector.h"
#include "detection/scaled_detectors.h"
#include "detection/segmenters/gradient_segmenter.h"
#include "detection/sliding_window/sliding_window_detector.h"

namespace eyrie {

namespace {

std::unique_ptr<Detector> makeFor(const DetectionOptions& options, const SceneScale& scale) {
    switch (options.method) {
        case DetectionMethod::clusters:
            return std::make_unique<MotionClusterDetector>(options.cluster_margin_px);
        case DetectionMethod::gradient:
            return std::make_unique<GradientSegmenter>(options.gradient, scale, options.cluster_margin_px);
        case DetectionMethod::relative_connectivity:
            return std::make_unique<RelativeConnectivitySegmenter>(options.relative_connectivity, options.gradient,
                                                                   scale, options.cluster_margin_px);
        case DetectionMethod::sliding_window:
            return makeSlidingWindowDetector(options.sliding_window, scale, options.cluster_margin_px);
        case DetectionMethod::window_and_gradient: {
            SlidingWindowOptions window = options.sliding_window;
            window.fall_back = false;
            window.rejection_margin = options.window_and_gradient.rejection_margin;
            return std::make_unique<WindowAndGradientDetector>(
                makeSlidingWindowDetector(window, scale, options.cluster_margin_px),
                std::make_unique<GradientSegmenter>(options.gradient, scale, options.cluster_margin_px),
                options.window_and_gradient, cvFloor(scale.px(window.context_m)));
        }
        case DetectionMethod::tophat_otsu:
            return std::make_unique<TophatOtsuSegmenter>(options.tophat_otsu, options.gradient, scale,
                                                         options.cluster_margin_px);
        case DetectionMethod::mser:
            return std::make_unique<MserSegmenter>(options.mser, options.gradient, scale, options.cluster_margin_px);
        case DetectionMethod::canny_harris:
            return std::make_unique<CannyHarrisSegmenter>(options.canny_harris, options.gradient, scale,
                                                          options.cluster_margin_px);
    }
    throw Error(ErrorKind::internal,
                "there is no detector with number " + std::to_string(static_cast<int>(options.method)));
}

}  // namespace

std::unique_ptr<Detector> makeDetector(const DetectionOptions& options, const SceneScale& scale) {
    if (scale.slope.isFlat()) return makeFor(options, scale);
    return std::make_unique<ScaledDetectors>(scale,
                                             [options](const SceneScale& here) { return makeFor(options, here); });
}

}  // namespace eyrie
