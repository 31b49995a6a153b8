/// Causes of errors on both sides of every limit, from evidence that is written down.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "diagnosis/error_cause.h"
#include "evaluation/evaluation_boxes.h"
#include "motion/clusters/clustering_wording.h"

namespace eyrie::causes_by_hand_test {
namespace {

using test::car;

cv::Point2d towards(double angle, double speed) {
    return {speed * std::cos(angle), speed * std::sin(angle)};
}

/// A frame in which track 7 finds object 1 at (50, 50); box 1 of the result is a false alarm.
struct Scene {
    std::vector<BoxRecord> truth{car(0, 1, 50)};
    std::vector<BoxRecord> result{car(0, 7, 50), car(0, 8, 300)};
    EvaluationFrame frame;
    FrameMatch match;
    BoxFacts facts;
    bool has_facts = false;
    double min_overlap = 0.1;
    bool upright = false;

    Scene() {
        match.pairs = {{0, 0, 1}};
        frame.results = {0, 1};
    }
    BoxRecord& alarm() { return result[1]; }
    ErrorEvidence evidence() const {
        return {.truth = truth,
                .result = result,
                .frame = frame,
                .match = match,
                .min_overlap = min_overlap,
                .upright = upright,
                .facts = has_facts ? &facts : nullptr,
                .object_facts = {}};
    }
    CauseHere ofAlarm() const { return causeOfFalseAlarm({0, result[1].box, {}, {1}}, evidence()); }
    /// The last object is missed.
    CauseHere ofMiss() const {
        const int missed = static_cast<int>(truth.size()) - 1;
        return causeOfMiss({0, truth.back().box, {missed}, {}}, evidence());
    }
};

}  // namespace

TEST(CausesByHand, AShadowIsWithinTwoLengthsAndMovesAlike) {
    const auto isShadow = [](cv::Point2d offset, cv::Point2d velocity) {
        Scene scene;
        scene.result[0].velocity = {4, 0};
        scene.alarm().box.centre = cv::Point2d(50, 50) + offset;
        scene.alarm().velocity = velocity;
        return scene.ofAlarm().cause == ErrorCause::shadow;
    };
    EXPECT_TRUE(isShadow({0, 39.9}, {4, 0}));
    EXPECT_FALSE(isShadow({0, 40.1}, {4, 0}));
    EXPECT_FALSE(isShadow({-30, 30}, {4, 0}));
    for (const double side : {1.0, -1.0}) {
        EXPECT_TRUE(isShadow({0, 30}, towards(side * 0.44, 4)));
        EXPECT_FALSE(isShadow({0, 30}, towards(side * 0.46, 4)));
    }
    EXPECT_TRUE(isShadow({0, 30}, {5.59, 0}));
    EXPECT_FALSE(isShadow({0, 30}, {5.61, 0})) << "two fifths faster";
    EXPECT_TRUE(isShadow({0, 30}, {2.41, 0}));
    EXPECT_FALSE(isShadow({0, 30}, {2.39, 0}));
}

TEST(CausesByHand, AShadowNamesWhomItMovesWithOfSeveral) {
    Scene scene;
    scene.truth.push_back(car(0, 2, 100));
    scene.result.push_back(car(0, 9, 100));
    scene.match.pairs.push_back({1, 2, 1});
    scene.result[0].velocity = {-4, 0};
    scene.result[2].velocity = scene.alarm().velocity = {4, 0};
    scene.alarm().box.centre = {80, 70};
    EXPECT_EQ(scene.ofAlarm().cause, ErrorCause::shadow);
    EXPECT_EQ(scene.ofAlarm().text, "moves along beside object 2");
}

TEST(CausesByHand, ParallaxGoesAlongTheCamerasFlowAndNoFaster) {
    const auto isParallax = [](cv::Point2d flow, cv::Point2d velocity) {
        Scene scene;
        scene.has_facts = true;
        scene.facts.flow = flow;
        scene.alarm().velocity = velocity;
        return scene.ofAlarm().cause == ErrorCause::parallax;
    };
    EXPECT_TRUE(isParallax({1, 0}, towards(0.34, 0.5)));
    EXPECT_FALSE(isParallax({1, 0}, towards(0.36, 0.5)));
    EXPECT_TRUE(isParallax({1, 0}, {-0.5, 0})) << "right against it";
    EXPECT_TRUE(isParallax({1, 0}, towards(kPi - 0.34, 0.5)));
    EXPECT_FALSE(isParallax({1, 0}, towards(kPi - 0.36, 0.5)));
    EXPECT_TRUE(isParallax({0.31, 0}, {0.2, 0}));
    EXPECT_FALSE(isParallax({0.29, 0}, {0.2, 0})) << "a camera that hardly moves";
    EXPECT_TRUE(isParallax({1, 0}, {0.99, 0}));
    EXPECT_FALSE(isParallax({1, 0}, {1.01, 0}));
    EXPECT_FALSE(isParallax({1, 0}, {0, 0})) << "of no direction";
}

TEST(CausesByHand, WhatHardlyMovesByItselfMovesAsItsVectorsDo) {
    Scene scene;
    scene.has_facts = true;
    scene.facts.flow = {1, 0};
    scene.facts.velocity = {0, 0.5};
    scene.facts.motion_vectors = 3;
    scene.alarm().velocity = {0.021, 0};
    EXPECT_EQ(scene.ofAlarm().cause, ErrorCause::parallax);
    scene.alarm().velocity = {0.019, 0};
    EXPECT_EQ(scene.ofAlarm().cause, ErrorCause::unlabelled);
    EXPECT_EQ(scene.ofAlarm().text, "3 motion vectors of 0.50 px/frame");
    scene.facts.motion_vectors = 0;
    EXPECT_EQ(scene.ofAlarm().cause, ErrorCause::unknown);
}

TEST(CausesByHand, ThreeTenthsOnAnObjectThatIsFoundMakeADuplicate) {
    Scene scene;
    scene.alarm().box.centre.x = 50 + 13.9;
    EXPECT_EQ(scene.ofAlarm().cause, ErrorCause::duplicate);
    EXPECT_EQ(scene.ofAlarm().text, "object 1 is found by track 7");
    scene.truth[0].id.reset();
    EXPECT_EQ(scene.ofAlarm().text, "another object is found by track 7");
    scene.alarm().box.centre.x = 50 + 14.1;
    EXPECT_EQ(scene.ofAlarm().cause, ErrorCause::unknown);
}

TEST(CausesByHand, ABoxThatIsOffIsThatOfTheMissedObjectThatItOverlapsMost) {
    for (const bool turned_round : {false, true}) {
        Scene scene;
        scene.truth.push_back(car(0, turned_round ? 3 : 2, turned_round ? 305 : 315));
        scene.truth.push_back(car(0, turned_round ? 2 : 3, turned_round ? 315 : 305));
        scene.match.missed = {1, 2};
        scene.min_overlap = 0.7;
        EXPECT_EQ(scene.ofAlarm().cause, ErrorCause::box_off);
        EXPECT_EQ(scene.ofAlarm().text, "object 3: overlap 0.60, 0.70 is needed");
    }
}

TEST(CausesByHand, WhatDoesNotCountIsBesideABoxIfBothGrownBySixTenthsTouch) {
    Scene scene;
    scene.truth.push_back(car(0, 2, 300 + 31.9));
    scene.frame.ignored_truth = {1};
    EXPECT_EQ(scene.ofAlarm().cause, ErrorCause::ignored_object);
    EXPECT_EQ(scene.ofAlarm().text, "beside an ignored object (car)");
    scene.truth[1].object_class.clear();
    EXPECT_EQ(scene.ofAlarm().text, "");
    scene.truth[1].box.centre.x = 300 + 32.1;
    EXPECT_EQ(scene.ofAlarm().cause, ErrorCause::unknown);
    scene.truth[1].box.centre = {300, 50 + 15.9};
    EXPECT_EQ(scene.ofAlarm().cause, ErrorCause::ignored_object);
}

TEST(CausesByHand, ThePictureReachesHalfAPixelBeyondItsCentres) {
    Scene scene;
    scene.has_facts = true;
    scene.facts.image = {640, 480};
    const auto isOutside = [&](cv::Point2d centre) {
        scene.alarm().box.centre = centre;
        return scene.ofAlarm().cause == ErrorCause::outside_image;
    };
    for (const cv::Point2d in :
         {cv::Point2d(-0.4, 200), cv::Point2d(639.4, 200), cv::Point2d(200, -0.4), cv::Point2d(200, 479.4)})
        EXPECT_FALSE(isOutside(in)) << in;
    for (const cv::Point2d out :
         {cv::Point2d(-0.6, 200), cv::Point2d(639.6, 200), cv::Point2d(200, -0.6), cv::Point2d(200, 479.6)})
        EXPECT_TRUE(isOutside(out)) << out;
}

TEST(CausesByHand, ABoxIsOffFromAQuarterOfTheOverlapNeeded) {
    const auto missWith = [](double overlap) {
        Scene scene;
        scene.truth.push_back(car(0, 2, 300 + test::shiftFor(overlap)));
        scene.min_overlap = 0.4;
        return scene.ofMiss();
    };
    EXPECT_EQ(missWith(0.101).cause, ErrorCause::box_off);
    EXPECT_EQ(missWith(0.099).cause, ErrorCause::unknown);
    EXPECT_EQ(missWith(0.31).text, "overlap 0.31, 0.40 is needed");
    // The same of a detection, where no track is near.
    Scene scene;
    scene.truth.push_back(car(0, 2, 500));
    scene.min_overlap = 0.4;
    scene.has_facts = true;
    scene.facts.clusters = {0};
    scene.facts.motion_vectors = 5;
    scene.facts.kept = {0, 0.101};
    EXPECT_EQ(scene.ofMiss().text, "detection: overlap 0.10, 0.40 is needed");
    scene.facts.kept = {0, 0.099};
    EXPECT_EQ(scene.ofMiss().cause, ErrorCause::not_detected);
    scene.facts.kept = {0, 0.4};
    EXPECT_EQ(scene.ofMiss().cause, ErrorCause::not_associated);
}

TEST(CausesByHand, AMissedObjectUnderABoxThatFoundAnotherIsMerged) {
    Scene scene;
    scene.truth.push_back(car(0, 2, 50 + test::shiftFor(0.41)));
    scene.min_overlap = 0.4;
    EXPECT_EQ(scene.ofMiss().cause, ErrorCause::merged);
    EXPECT_EQ(scene.ofMiss().text, "its box went to object 1");
    scene.truth[1] = car(0, 2, 50 + test::shiftFor(0.39));
    EXPECT_EQ(scene.ofMiss().cause, ErrorCause::unknown) << "too little, and the box is taken";
}

TEST(CausesByHand, BoxesAreComparedUprightWhereTheEvaluationDoes) {
    Scene scene;
    scene.truth.push_back(car(0, 2, 300));
    scene.truth[1].box.heading = kPi / 4;
    const double side = 30 / std::sqrt(2.0);  // of the upright box around 20 × 10 px that lie aslant
    scene.alarm().box.length = scene.alarm().box.width = side;
    scene.min_overlap = 1.01;
    EXPECT_EQ(scene.ofMiss().text, "overlap 0.44, 1.01 is needed");
    scene.upright = true;
    EXPECT_EQ(scene.ofMiss().text, "overlap 1.00, 1.01 is needed");
}

TEST(CausesByHand, CornersAreJudgedOnceTheyAreOldEnough) {
    Scene scene;
    scene.truth.push_back(car(0, 2, 500));
    scene.has_facts = true;
    scene.facts.corners = 4;
    const auto missAfter = [&](int frames) {
        ErrorEvidence evidence = scene.evidence();
        evidence.frames_in_view = frames;
        evidence.frames_needed = 5;
        return causeOfMiss({0, scene.truth[1].box, {1}, {}}, evidence).cause;
    };
    EXPECT_EQ(missAfter(4), ErrorCause::too_new);
    EXPECT_EQ(missAfter(5), ErrorCause::too_slow);
    scene.facts.corners = 1;
    EXPECT_EQ(missAfter(5), ErrorCause::too_slow);
    scene.facts.corners = 0;
    EXPECT_EQ(missAfter(5), ErrorCause::no_corners);
}

TEST(CausesByHand, OfSeveralMergedObjectsTwoThatShareAreEnough) {
    BoxFacts one, two, three;
    one.clusters = {4, 2};
    two.clusters = {5};
    three.clusters = {2};
    one.covering = three.covering = {0};
    const Scene scene;
    ErrorEvidence evidence = scene.evidence();
    const auto causeWith = [&](std::vector<const BoxFacts*> objects) {
        evidence.object_facts = std::move(objects);
        return causeOfMerge({}, evidence).cause;
    };
    EXPECT_EQ(causeWith({&one, &two, &three}), ErrorCause::clustered_together);
    EXPECT_EQ(causeWith({&one, &two}), ErrorCause::tracked_together);
    EXPECT_EQ(causeWith({&one}), ErrorCause::unknown);
    three.clusters = {6};
    EXPECT_EQ(causeWith({&one, &two, &three}), ErrorCause::segmented_together);
}

TEST(CausesByHand, WhatFollowsAFrameThatWasNotRegisteredIsExplainedByItEvenWithoutFacts) {
    Scene scene;
    const auto causeAfter = [&](bool recently) {
        ErrorEvidence evidence = scene.evidence();
        evidence.recently_unregistered = recently;
        return causeOfFalseAlarm({0, scene.alarm().box, {}, {1}}, evidence);
    };
    EXPECT_EQ(causeAfter(true).cause, ErrorCause::unregistered) << "nothing is stored of this frame";
    EXPECT_EQ(causeAfter(true).text, "");
    scene.has_facts = true;
    EXPECT_EQ(causeAfter(true).cause, ErrorCause::unregistered) << "it was registered itself";
    EXPECT_EQ(causeAfter(false).cause, ErrorCause::unknown);
    scene.facts.registration = RegistrationState::failed;
    scene.facts.failure = {.fault = RegistrationFault::too_few_agree, .count = 12, .of = 40};
    EXPECT_EQ(causeAfter(false).cause, ErrorCause::unregistered);
    EXPECT_NE(causeAfter(false).text.find("12 of 40"), std::string::npos);
    scene.alarm().origin = StateOrigin::predicted;
    EXPECT_EQ(causeAfter(false).cause, ErrorCause::unregistered) << "which is why it was only predicted";
}

TEST(CausesByHand, TheLastStageThatHadTheObjectDecides) {
    Scene scene;
    scene.truth.push_back(car(0, 2, 500));
    scene.min_overlap = 0.4;
    scene.has_facts = true;
    BoxFacts& facts = scene.facts;
    const auto expect = [&](ErrorCause cause, const std::string& text) {
        EXPECT_EQ(scene.ofMiss().cause, cause);
        EXPECT_EQ(scene.ofMiss().text, text);
    };
    expect(ErrorCause::no_corners, "");
    facts.corners = 2;
    expect(ErrorCause::too_slow, "2 corners, none counts as moving");
    facts.motion_vectors = 1;
    facts.clustering.refusal = ClusterRefusal::not_finite;
    expect(ErrorCause::not_clustered, "1 motion vectors");
    facts.by_differences = true;
    expect(ErrorCause::not_clustered, "1 motion vectors, but " + std::string(kNoMovingArea) + " (motion.method)");
    facts.clusters = {3};
    expect(ErrorCause::not_detected, "1 motion vectors in a cluster");
    facts.registration = RegistrationState::failed;
    EXPECT_EQ(scene.ofMiss().cause, ErrorCause::unregistered);
    facts.rejected.overlap = 0.4;
    facts.removal.rejection = Rejection::duplicate;
    expect(ErrorCause::removed_duplicate, "removed as a duplicate of another detection");
    facts.kept.overlap = 0.4;
    expect(ErrorCause::not_associated, "a detection overlaps it by 0.40");
    facts.dropped.overlap = 0.4;
    facts.drop.why = TrackDrop::too_small;
    EXPECT_EQ(scene.ofMiss().cause, ErrorCause::track_dropped);
    facts.tentative.overlap = 0.4;
    facts.unconfirmed.why = TrackDrop::unconfirmed;
    EXPECT_EQ(scene.ofMiss().cause, ErrorCause::tentative);
    facts.tentative.overlap = facts.dropped.overlap = facts.kept.overlap = facts.rejected.overlap = 0.39;
    EXPECT_EQ(scene.ofMiss().cause, ErrorCause::box_off) << "none of them enough, but a detection is near";
}

TEST(CausesByHand, OfSeveralBoxesAtTheBorderOrOfOtherClassesOneIsEnough) {
    Scene scene;
    scene.truth.push_back(car(0, 2, 500));
    scene.result.push_back(car(0, 9, 500));
    scene.result.push_back(car(0, 10, 700));
    scene.result[2].object_class = "bus";
    scene.frame.other_class_results = {3, 2};
    EXPECT_EQ(scene.ofMiss().cause, ErrorCause::other_class);
    EXPECT_EQ(scene.ofMiss().text, "called bus");
    scene.frame.border_results = {3, 2};
    EXPECT_EQ(scene.ofMiss().cause, ErrorCause::at_border);
    scene.truth[1].box.centre.x = 900;
    EXPECT_EQ(scene.ofMiss().cause, ErrorCause::unknown);
}

TEST(CausesByHand, OfTheMissedObjectsBesideAnAlarmOneThatTouchesItLessDoesNotEndTheSearch) {
    Scene scene;
    scene.truth.push_back(car(0, 2, 315));
    scene.truth.push_back(car(0, 3, 500));
    scene.truth.push_back(car(0, 4, 305));
    scene.match.missed = {1, 2, 3};
    scene.min_overlap = 0.7;
    EXPECT_EQ(scene.ofAlarm().text, "object 4: overlap 0.60, 0.70 is needed");
}

TEST(CausesByHand, ASplitIsOneOfClustersWhereThereAreSeveral) {
    Scene scene;
    EXPECT_EQ(causeOfSplit({}, scene.evidence()).cause, ErrorCause::unknown);
    scene.has_facts = true;
    EXPECT_EQ(causeOfSplit({}, scene.evidence()).cause, ErrorCause::unknown);
    scene.facts.clusters = {4};
    EXPECT_EQ(causeOfSplit({}, scene.evidence()).cause, ErrorCause::segmented_apart);
    scene.facts.clusters = {4, 2, 7};
    EXPECT_EQ(causeOfSplit({}, scene.evidence()).cause, ErrorCause::clustered_apart);
    EXPECT_EQ(causeOfSplit({}, scene.evidence()).text, "3 clusters");
}

}  // namespace eyrie::causes_by_hand_test
