#include "contract/detector_contract.h"

#include "detection/detector_factory.h"

namespace eyrie::test {
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
                                         maker("defaults", DetectionOptions{})),
                         nameOf);

}  // namespace eyrie::test
