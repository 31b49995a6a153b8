#include "contract/detector_contract.h"

#include "detection/detector_factory.h"
#include "detection/trained_window_model.h"

namespace eyrie::test::detector_contract_test {
namespace {

DetectorMaker maker(const std::string& name, const DetectionOptions& options) {
    return {name, [options] { return makeDetector(options, kContractScale); }};
}

DetectionOptions withMethod(GradientMethod method) {
    DetectionOptions options;
    options.method = DetectionMethod::gradient;
    options.gradient.method = method;
    options.gradient.fall_back = false;
    return options;
}

DetectionOptions baseline() {
    DetectionOptions options;
    options.method = DetectionMethod::clusters;
    return options;
}

DetectionOptions ofKind(DetectionMethod method) {
    DetectionOptions options;
    options.method = method;
    options.gradient.fall_back = false;
    return options;
}

DetectorMaker slidingWindow(const std::string& name, WindowRescaling rescaling,
                            DetectionMethod method = DetectionMethod::sliding_window) {
    return {name, [rescaling, method] {
                DetectionOptions options = ofKind(method);
                options.window_and_gradient.sure_decision = 1;
                options.sliding_window = drivenSceneWindow();
                options.sliding_window.rescaling = rescaling;
                options.sliding_window.smallest_scale = 0.9;
                options.sliding_window.largest_scale = 1.1;
                return makeDetector(options, kContractScale);
            }};
}

std::string nameOf(const testing::TestParamInfo<DetectorMaker>& info) {
    return info.param.name;
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(Clusters, DetectorContract, testing::Values(maker("clusters", baseline())), nameOf);
INSTANTIATE_TEST_SUITE_P(Gradient, DetectorContract,
                         testing::Values(maker("lbp", withMethod(GradientMethod::lbp)),
                                         maker("simple", withMethod(GradientMethod::simple)),
                                         maker("canny", withMethod(GradientMethod::canny)),
                                         maker("morphological", withMethod(GradientMethod::morphological)),
                                         maker("thesis", DetectionOptions::thesis()),
                                         maker("defaults", ofKind(DetectionMethod::gradient))),
                         nameOf);

INSTANTIATE_TEST_SUITE_P(Literature, DetectorContract,
                         testing::Values(maker("relative_connectivity", ofKind(DetectionMethod::relative_connectivity)),
                                         maker("tophat_otsu", ofKind(DetectionMethod::tophat_otsu)),
                                         maker("mser", ofKind(DetectionMethod::mser)),
                                         maker("canny_harris", ofKind(DetectionMethod::canny_harris))),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(SlidingWindow, DetectorContract,
                         testing::Values(slidingWindow("joint_11", WindowRescaling::joint_11),
                                         slidingWindow("length_11", WindowRescaling::length_11),
                                         slidingWindow("length_3", WindowRescaling::length_3),
                                         slidingWindow("with_gradient", WindowRescaling::length_3,
                                                       DetectionMethod::window_and_gradient)),
                         nameOf);

}  // namespace eyrie::test::detector_contract_test
