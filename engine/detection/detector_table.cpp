#include "detection/detector_table.h"

#include <string>
#include <type_traits>
#include <utility>

#include "core/error.h"
#include "detection/motion_cluster_detector.h"
#include "detection/segmenters/gradient_segmenter.h"
#include "detection/sliding_window/sliding_window_detector.h"

namespace eyrie {
namespace {

using Made = std::unique_ptr<Detector>;

template <auto Own>
void describeOwn(DetectionOptions& options, ParameterVisitor& visitor) {
    (options.*Own).describe(visitor);
}

template <auto Own>
void setOwnAsInThesis(DetectionOptions& options) {
    options.*Own = std::remove_reference_t<decltype(options.*Own)>::thesis();
}

void describeNothing(DetectionOptions&, ParameterVisitor&) {}
void leaveAsItIs(DetectionOptions&) {}

/// A segmentation with options of its own; what gradient.* says of components holds for it, too.
template <class Segmenter, auto Own>
Made makeSegmenter(const DetectionOptions& options, const SceneScale& scale) {
    return std::make_unique<Segmenter>(options.*Own, options.gradient, scale, options.cluster_margin);
}

Made makeClusters(const DetectionOptions& options, const SceneScale&) {
    return std::make_unique<MotionClusterDetector>(options.cluster_margin);
}

Made makeGradient(const DetectionOptions& options, const SceneScale& scale) {
    return std::make_unique<GradientSegmenter>(options.gradient, scale, options.cluster_margin);
}

Made makeWindow(const DetectionOptions& options, const SceneScale& scale) {
    return makeSlidingWindowDetector(options.sliding_window, scale, options.cluster_margin);
}

Made makeWindowAndGradient(const DetectionOptions& options, const SceneScale& scale) {
    SlidingWindowOptions window = options.sliding_window;
    window.fall_back = false;
    window.rejection_margin = options.window_and_gradient.rejection_margin;
    return std::make_unique<WindowAndGradientDetector>(makeSlidingWindowDetector(window, scale, options.cluster_margin),
                                                       makeGradient(options, scale), options.window_and_gradient,
                                                       cvFloor(scale.px(window.context_m)));
}

using Options = DetectionOptions;
/// All detectors, in the order of their enumerators and of tables 7.6 and 7.7.
constexpr std::pair<DetectionMethod, DetectorKind> kKinds[] = {
    {DetectionMethod::clusters, {"clusters", false, false, describeNothing, leaveAsItIs, makeClusters}},
    {DetectionMethod::gradient,
     {"gradient", false, false, describeOwn<&Options::gradient>, setOwnAsInThesis<&Options::gradient>, makeGradient}},
    {DetectionMethod::relative_connectivity,
     {"relative_connectivity", false, false, describeOwn<&Options::relative_connectivity>,
      setOwnAsInThesis<&Options::relative_connectivity>,
      makeSegmenter<RelativeConnectivitySegmenter, &Options::relative_connectivity>}},
    {DetectionMethod::sliding_window,
     {"sliding_window", true, true, describeOwn<&Options::sliding_window>, setOwnAsInThesis<&Options::sliding_window>,
      makeWindow}},
    {DetectionMethod::window_and_gradient,
     {"window_and_gradient", true, false, describeOwn<&Options::window_and_gradient>, leaveAsItIs,
      makeWindowAndGradient}},
    {DetectionMethod::tophat_otsu,
     {"tophat_otsu", false, false, describeOwn<&Options::tophat_otsu>, setOwnAsInThesis<&Options::tophat_otsu>,
      makeSegmenter<TophatOtsuSegmenter, &Options::tophat_otsu>}},
    {DetectionMethod::mser,
     {"mser", false, false, describeOwn<&Options::mser>, setOwnAsInThesis<&Options::mser>,
      makeSegmenter<MserSegmenter, &Options::mser>}},
    {DetectionMethod::canny_harris,
     {"canny_harris", false, false, describeOwn<&Options::canny_harris>, leaveAsItIs,
      makeSegmenter<CannyHarrisSegmenter, &Options::canny_harris>}},
};

}  // namespace

const DetectorKind& kindOf(DetectionMethod method) {
    for (const auto& [known, kind] : kKinds)
        if (known == method) return kind;
    throw Error(ErrorKind::internal, "there is no detector with number " + std::to_string(static_cast<int>(method)));
}

const std::vector<DetectionMethod>& allDetectionMethods() {
    static const std::vector<DetectionMethod> all = [] {
        std::vector<DetectionMethod> methods;
        for (const auto& [method, kind] : kKinds) methods.push_back(method);
        return methods;
    }();
    return all;
}

}  // namespace eyrie
