#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/error.h"
#include "core/parameter.h"
#include "detection/detector_factory.h"
#include "detection/trained_window_model.h"
#include "support/driven_scene.h"

namespace eyrie::prepared_area_test {
namespace {

using test::drivenScene;

void expectSame(const std::vector<Detection>& a, const std::vector<Detection>& b, const std::string& what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].box.centre, b[i].box.centre) << what;
        EXPECT_EQ(a[i].box.length, b[i].box.length) << what;
        EXPECT_EQ(a[i].box.width, b[i].box.width) << what;
        EXPECT_EQ(a[i].box.heading, b[i].box.heading) << what;
        EXPECT_EQ(a[i].score, b[i].score) << what;
        EXPECT_EQ(a[i].complete, b[i].complete) << what;
        EXPECT_EQ(a[i].cluster, b[i].cluster) << what;
    }
}

/// Areas in the middle of the image and at its edge, where part of them is padding.
std::vector<MotionRoi> areas() {
    std::vector<MotionRoi> all;
    for (const double heading : {0.0, 0.4, 1.2, 2.3, -1.9}) {
        all.push_back(test::roiOf(drivenScene(heading)));
        all.push_back(test::roiOf(drivenScene(heading, {12, 9}, 3)));
        all.push_back(test::roiOf(drivenScene(heading, {310, 120}, 4)));
    }
    return all;
}

/// Names of the parameters that are declared to have no part in prepare().
std::set<std::string> decisionOnly() {
    DetectionOptions options;
    std::set<std::string> names;
    for (const Parameter& parameter : listParameters(describeOf(options)))
        if (parameter.effect.decision_only) names.insert(parameter.name);
    return names;
}

struct LateChange {
    DetectionMethod method;
    std::string name;
    std::vector<std::string> values;
};

}  // namespace

TEST(PreparedArea, DecidesWithOtherParametersAsItWouldDetect) {
    const std::vector<LateChange> changes{
        {DetectionMethod::gradient, "gradient.quantile", {"0", "0.01", "0.05", "0.12", "0.35", "0.7", "1"}},
        {DetectionMethod::gradient, "gradient.min_box_area", {"1", "60", "400"}},
        {DetectionMethod::gradient, "gradient.need_support", {"false", "true"}},
        {DetectionMethod::gradient, "gradient.support_share", {"0", "0.5"}},
        {DetectionMethod::gradient, "gradient.handle_cut", {"false", "true"}},
        {DetectionMethod::gradient, "gradient.core_margin", {"0", "2"}},
        {DetectionMethod::gradient, "gradient.join_components", {"false", "true"}},
        {DetectionMethod::gradient, "gradient.vehicle_length", {"2", "8"}},
        {DetectionMethod::gradient, "gradient.vehicle_width", {"1", "4"}},
        {DetectionMethod::gradient, "gradient.growth_along", {"0", "1"}},
        {DetectionMethod::gradient, "gradient.growth_across", {"0", "1"}},
        {DetectionMethod::gradient, "gradient.length_correction", {"0", "2"}},
        {DetectionMethod::gradient, "gradient.width_correction", {"0", "2"}},
        {DetectionMethod::gradient, "gradient.fall_back", {"false", "true"}},
        {DetectionMethod::gradient, "gradient.fall_back_share", {"0", "1"}},
        {DetectionMethod::gradient, "detection.cluster_margin", {"0", "3"}},
        {DetectionMethod::mser, "gradient.min_box_area", {"1", "60"}},
        {DetectionMethod::sliding_window, "sliding_window.decision_threshold", {"-1000", "-3", "0", "2", "50"}},
        {DetectionMethod::sliding_window, "sliding_window.overlap_threshold", {"0", "0.4", "1"}},
        {DetectionMethod::sliding_window, "sliding_window.need_support", {"false", "true"}},
        {DetectionMethod::sliding_window, "sliding_window.support_share", {"0", "0.9"}},
        {DetectionMethod::sliding_window, "sliding_window.fall_back", {"false", "true"}},
        {DetectionMethod::window_and_gradient, "window_and_gradient.sure_decision", {"-5", "1", "100"}},
        {DetectionMethod::window_and_gradient, "window_and_gradient.most_covered", {"0", "1"}},
        {DetectionMethod::window_and_gradient, "gradient.quantile", {"0.05", "0.5"}},
    };
    const auto rois = areas();
    std::set<std::string> untried = decisionOnly();
    for (const LateChange& change : changes) untried.erase(change.name);
    EXPECT_THAT(untried, testing::IsEmpty());
    const std::set<std::string> declared = decisionOnly();
    for (const LateChange& change : changes) {
        EXPECT_EQ(declared.count(change.name), 1U) << change.name;
        DetectionOptions options;
        options.method = change.method;
        options.sliding_window = test::drivenSceneWindow();
        options.window_and_gradient.sure_decision = 1;
        const auto preparing = makeDetector(options, test::kContractScale);
        for (const std::string& value : change.values) {
            setParameter(describeOf(options), change.name, value);
            const auto changed = makeDetector(options, test::kContractScale);
            for (const MotionRoi& roi : rois) {
                const auto prepared = preparing->prepare(roi);
                expectSame(changed->detect(roi), changed->decide(roi, prepared.get()), change.name + " = " + value);
            }
        }
    }
}

TEST(PreparedArea, ParametersThatPrepareItAreNotDeclaredAsDecisionOnly) {
    const std::set<std::string> declared = decisionOnly();
    EXPECT_EQ(declared.size(), 23U);
    for (const char* preparing : {"gradient.lbp_threshold", "gradient.quantile_area", "detection.extend_along"})
        EXPECT_EQ(declared.count(preparing), 0U) << preparing;
}

TEST(PreparedArea, TellsAtLeastTheMemoryThatItsWindowsTake) {
    DetectionOptions options;
    options.method = DetectionMethod::sliding_window;
    options.sliding_window = test::drivenSceneWindow();
    options.sliding_window.decision_threshold = -1000;
    options.sliding_window.overlap_threshold = 1;
    options.sliding_window.rejection_margin = 1000;  // none is given up
    options.sliding_window.need_support = false;
    const auto detector = makeDetector(options, test::kContractScale);
    const MotionRoi roi = test::roiOf(drivenScene(0.4));
    const auto prepared = detector->prepare(roi);
    ASSERT_NE(prepared, nullptr);
    // Each window that is kept for a later decision has four edges and a value, at least.
    const std::size_t windows = detector->decide(roi, prepared.get()).size();
    ASSERT_GT(windows, 10U);
    EXPECT_GE(prepared->bytes(), windows * 5 * sizeof(float));
}

TEST(PreparedArea, OfAnEmptyAreaIsNothing) {
    DetectionOptions options;
    options.method = DetectionMethod::gradient;
    const auto detector = makeDetector(options, test::kContractScale);
    EXPECT_EQ(detector->prepare({}), nullptr);
    EXPECT_TRUE(detector->decide({}, nullptr).empty());
}

}  // namespace eyrie::prepared_area_test
