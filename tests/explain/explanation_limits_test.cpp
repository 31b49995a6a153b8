/// What is told on either side of the limits that decide how it is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "explain/empty_place.h"
#include "tracking/finishing/track_score.h"

namespace eyrie::explanation_limits_test {
namespace {

using testing::HasSubstr;

const SceneScale kScale = test::kPlaceScale;  // a car is 18 px long

CornerVerdict corner(CornerFate fate, double speed = 0, double limit = 1, int age = 20) {
    CornerVerdict verdict;
    verdict.position = {100, 100};
    verdict.fate = fate;
    verdict.age = age;
    verdict.speed = speed;
    verdict.limit = limit;
    verdict.baseline = 12;
    return verdict;
}

Explanation ofCorners(CornerVerdicts corners) {
    PlaceEvidence evidence = test::emptyPlace();
    evidence.corners = std::move(corners);
    return explain(evidence, {}, kScale);
}

/// Three vectors in a cluster whose search area of 14 × 30 px was searched with these checks.
Explanation ofChecks(const std::vector<DetectionTrace::Check>& checks) {
    PlaceEvidence evidence = test::emptyPlace();
    for (const float x : {95.F, 100.F, 105.F})
        evidence.result.motion.motion_vectors.push_back({CornerId(x), {x, 100}, {2, 0}, 20});
    MotionCluster cluster;
    cluster.box = {{100, 100}, 13, 5, 0};
    cluster.members = {0, 1, 2};
    evidence.result.clusters = {cluster};
    SearchTrace search;
    search.roi.box = {{100, 100}, 30, 14, 0};
    search.roi.cluster = 0;
    search.roi.image_from_roi = {0, -1, 114.5, 1, 0, 93.5};
    search.trace.checks = checks;
    evidence.searches = {search};
    return explain(evidence, {}, kScale);
}

std::vector<std::string> textsOf(const Explanation& told, const std::string& stage) {
    std::vector<std::string> texts;
    for (const ExplanationStep& step : told.steps)
        if (step.stage == stage) texts.push_back(step.text);
    return texts;
}

constexpr auto kThreshold = "sliding_window.decision_threshold", kArea = "gradient.min_box_area";

}  // namespace

TEST(ExplanationLimits, APlaceIsACarLongAndEightPixelsAtLeast) {
    EXPECT_EQ(placeAt({7, 9}, kScale).length, 18);
    EXPECT_EQ(placeAt({7, 9}, kScale).width, 18);
    EXPECT_EQ(placeAt({7, 9}, {1, 25, true}).length, 8);
    EXPECT_EQ(placeAt({7, 9}, {0.5, 25, true}).length, 9);
    EXPECT_EQ(placeAt({7, 9}, kScale).centre, cv::Point2d(7, 9));
}

TEST(ExplanationLimits, AQuarterOfTheCornersIsEnoughToOutweighTheSlowOnes) {
    const CornerVerdict slow = corner(CornerFate::slow, 0.1), fast = corner(CornerFate::too_fast, 20, 10);
    EXPECT_THAT(ofCorners({fast, slow, slow, slow}).sentence, HasSubstr("at most 10 px/frame"));
    EXPECT_THAT(ofCorners({fast, slow, slow, slow, slow}).sentence, HasSubstr("The fastest corner here moves 0.1"));
    const CornerVerdict young = corner(CornerFate::young, 0, 1, 2), older = corner(CornerFate::young, 0, 1, 4);
    EXPECT_THAT(ofCorners({young, older, young}).sentence, HasSubstr("tracked for 4 frames"));
    EXPECT_THAT(ofCorners({young, young, young, slow}).sentence, HasSubstr("The fastest corner here moves 0.1"))
        << "it came further";
}

TEST(ExplanationLimits, TheFastestCornerIsThatWhichCameClosestToItsOwnLimit) {
    const Explanation told = ofCorners(
        {corner(CornerFate::slow, 0.4, 1), corner(CornerFate::slow, 0.3, 0.5), corner(CornerFate::slow, 0.5, 2)});
    EXPECT_THAT(told.sentence, HasSubstr("moves 0.3 px/frame"));
    EXPECT_THAT(textsOf(told, "motion"), testing::Contains(HasSubstr("3 corners are too slow: fastest 0.3 px/frame")));
}

TEST(ExplanationLimits, AFrameIsFullFrom95PerCentOfItsCornersOn) {
    const auto toldWith = [](int corners) {
        PlaceEvidence evidence = test::emptyPlace();
        evidence.result.motion.corner_count = corners;
        ChainOptions options;
        options.registration.corners.max_corners = 2000;
        return explain(evidence, options, kScale).parameter;
    };
    EXPECT_EQ(toldWith(1900), "registration.max_corners");
    EXPECT_EQ(toldWith(1899), "registration.corner_deviation");
}

TEST(ExplanationLimits, ChecksOfAKindAreToldTogether) {
    const Explanation told = ofChecks({{"value", kThreshold, 2, 4, false, false},
                                       {"value", kThreshold, 1, 4, false, false},
                                       {"value", kThreshold, 3, 4, false, false},
                                       {"area", kArea, 8, 5, true, false},
                                       {"area", kArea, 8, 5, true, false}});
    EXPECT_THAT(textsOf(told, "detection"), testing::ElementsAre("value, 3 times: 1 … 3, at least 4",
                                                                 "area, 2 times: 8, at most 5", "no box here"));
    EXPECT_THAT(told.sentence, HasSubstr("closest was: value: 3, at least 4"));
}

TEST(ExplanationLimits, CloseIsMeantAsAShareOfTheLimitOrOfOne) {
    EXPECT_EQ(ofChecks({{"value", kThreshold, 3, 4, false, false}, {"area", kArea, 20, 40, false, false}}).parameter,
              kThreshold)
        << "a quarter before a half";
    EXPECT_EQ(ofChecks({{"area", kArea, 20, 40, false, false}, {"value", kThreshold, 3, 4, false, false}}).parameter,
              kThreshold);
    EXPECT_EQ(
        ofChecks({{"value", kThreshold, 2.2, 4, false, false}, {"area", kArea, 0.1, 0.5, false, false}}).parameter,
        kArea)
        << ".4 before .45";
    EXPECT_EQ(ofChecks({{"value", kThreshold, 3, 4, false, false}, {"area", kArea, 30, 40, false, false}}).parameter,
              kArea)
        << "of equals the later one";
}

TEST(ExplanationLimits, OnlyChecksOfBoxesAtThePlaceAreTold) {
    const auto isTold = [](const cv::Rect2d& box) {
        return textsOf(ofChecks({{"value", kThreshold, 3, 4, false, false, box}}), "detection").size() == 2;
    };
    EXPECT_TRUE(isTold({2, 5, 10, 20}));
    EXPECT_TRUE(isTold({})) << "about the whole area";
    EXPECT_TRUE(isTold({3.5, -12.5, 6, 30})) << "its middle lies 12 px ahead, but it is 30 px long";
    EXPECT_TRUE(isTold({3.5, 11.5, 30, 6})) << "12 px aside, but it is 30 px wide";
    EXPECT_FALSE(isTold({6, 20, 2, 30})) << "its middle lies 20 px behind";
    EXPECT_FALSE(isTold({30, 14, 30, 2})) << "beside";
}

TEST(ExplanationLimits, ATenthOfLogOddsTellsNothing) {
    const auto toldOfLife = [](double life_s) {
        PlaceEvidence evidence = test::emptyPlace();
        TrackState state;
        state.id = 7;
        state.box = {{100, 100}, 18, 7, 0};
        state.status = TrackStatus::confirmed;
        evidence.result.tracks = {state};
        evidence.judged[7].life_s = life_s;
        for (const std::string& text : textsOf(explain(evidence, {}, kScale), "score"))
            if (text.starts_with("it was followed")) return text;
        return std::string();
    };
    // The part of a life is .643 ln(life + .1 s).
    EXPECT_THAT(toldOfLife(1.05), HasSubstr("tells nothing, +0.09"));
    EXPECT_THAT(toldOfLife(1.1), HasSubstr("speaks for a moving vehicle, +0.12"));
    EXPECT_THAT(toldOfLife(0.78), HasSubstr("tells nothing, −0.08"));
    EXPECT_THAT(toldOfLife(0.74), HasSubstr("speaks against it, −0.11"));
}

}  // namespace eyrie::explanation_limits_test
