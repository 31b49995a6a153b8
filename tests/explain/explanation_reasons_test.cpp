/// Which of several things is told, the words of rare reasons, and limits that are met exactly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "explain/empty_place.h"
#include "tracking/finishing/track_score.h"

namespace eyrie::explanation_reasons_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using Lines = std::vector<std::string>;

const SceneScale kScale = test::kPlaceScale;  // a car is 18 px long, 1 px/frame are 6.25 m/s

CornerVerdict corner(CornerFate fate, int age = 20) {
    CornerVerdict verdict;
    verdict.position = {100, 100};
    verdict.fate = fate;
    verdict.age = age;
    verdict.speed = 2;
    verdict.limit = 1;
    verdict.baseline = 12;
    return verdict;
}

Explanation ofCorners(CornerVerdicts corners, const SceneScale& scale = kScale) {
    PlaceEvidence evidence = test::emptyPlace();
    evidence.corners = std::move(corners);
    return explain(evidence, test::withoutDensity(), scale);
}

/// Vectors in a row along the motion at these places.
PlaceEvidence withVectors(const std::vector<float>& xs) {
    PlaceEvidence evidence = test::emptyPlace();
    for (const float x : xs) {
        auto& vectors = evidence.result.motion.motion_vectors;
        vectors.push_back({static_cast<CornerId>(vectors.size()), {x, 100}, {2, 0}, 20});
    }
    return evidence;
}

void addCluster(PlaceEvidence& evidence, std::vector<int> members) {
    MotionCluster cluster;
    cluster.box = {{100, 100}, 13, 5, 0};
    cluster.members = std::move(members);
    evidence.result.clusters.push_back(cluster);
}

PlaceEvidence detected() {
    PlaceEvidence evidence = withVectors({94, 98, 102, 106});
    addCluster(evidence, {0, 1, 2, 3});
    Detection detection;
    detection.box = {{100, 100}, 18, 7, 0};
    detection.cluster = 0;
    detection.vectors = {0, 1, 2, 3};
    evidence.result.detections = {detection};
    return evidence;
}

TrackState stateAt(TrackId id, double x, TrackStatus status, StateOrigin origin = StateOrigin::detected) {
    TrackState state;
    state.id = id;
    state.box = {{x, 100}, 18, 7, 0};
    state.status = status;
    state.origin = origin;
    state.age = 9;
    state.hits = 3;
    return state;
}

Explanation told(PlaceEvidence evidence, const SceneScale& scale = kScale) {
    MotionClustering(test::withoutDensity().clustering, scale).cluster(evidence.result.motion, &evidence.clustering);
    return explain(evidence, test::withoutDensity(), scale);
}

Lines linesOf(const Explanation& explanation, const std::string& stage) {
    Lines lines;
    for (const ExplanationStep& step : explanation.steps) {
        if (step.stage != stage) continue;
        const std::string mark = step.verdict == StepVerdict::passed   ? "+ "
                                 : step.verdict == StepVerdict::failed ? "− "
                                                                       : "· ";
        lines.push_back(mark + step.text + (step.parameter.empty() ? "" : " @" + step.parameter));
    }
    return lines;
}

Lines scoreOf(const TrackEvidence& judged) {
    PlaceEvidence evidence = detected();
    evidence.result.tracks = {stateAt(7, 100, TrackStatus::confirmed)};
    evidence.judged[7] = judged;
    return linesOf(told(evidence), "score");
}

}  // namespace

TEST(ExplanationReasons, ACornerIsOldEnoughAtExactlyTheAgeThatIsNeeded) {
    EXPECT_THAT(linesOf(ofCorners({corner(CornerFate::slow, 5)}), "motion"),
                Contains("+ the oldest of 1 corner has been tracked 5 frames, 5 are needed @motion.min_age"));
    EXPECT_THAT(linesOf(ofCorners({corner(CornerFate::slow, 4), corner(CornerFate::slow, 3)}), "motion"),
                Contains("− the oldest of 2 corners has been tracked 4 frames, 5 are needed @motion.min_age"));
    EXPECT_THAT(linesOf(ofCorners({corner(CornerFate::slow, 3), corner(CornerFate::slow, 6)}), "motion"),
                Contains(StartsWith("+ the oldest of 2 corners has been tracked 6 frames")));
}

TEST(ExplanationReasons, OfFatesTheOneThatCameFurthestDecides) {
    const std::vector<std::pair<CornerFate, std::string>> furthest_first = {
        {CornerFate::shadow, "The corners here lie on the outline of a moving shadow"},
        {CornerFate::parallax, "The corners here move along the epipolar lines, 2 px/frame (12.5 m/s), no faster"},
        {CornerFate::too_fast, "The corners here move 2 px/frame (12.5 m/s), at most 1 px/frame (6.25 m/s) are"},
        {CornerFate::slow, "The fastest corner here moves 2 px/frame (12.5 m/s), 1 px/frame (6.25 m/s) are needed"},
        {CornerFate::young, "The oldest corner here has been tracked for 20 frames, 5 are needed"}};
    for (std::size_t i = 0; i < furthest_first.size(); ++i) {
        for (std::size_t k = i; k < furthest_first.size(); ++k) {
            const CornerVerdict a = corner(furthest_first[i].first), b = corner(furthest_first[k].first);
            EXPECT_THAT(ofCorners({b, a}).sentence, StartsWith(furthest_first[i].second)) << i << " " << k;
            EXPECT_THAT(ofCorners({a, b}).sentence, StartsWith(furthest_first[i].second)) << i << " " << k;
        }
    }
}

TEST(ExplanationReasons, AQuarterIsNeededOfEachFateThatMayBeOutweighed) {
    const CornerVerdict young = corner(CornerFate::young);
    for (const CornerFate fate : {CornerFate::shadow, CornerFate::parallax}) {
        EXPECT_THAT(ofCorners({corner(fate), young, young, young}).sentence, Not(HasSubstr("oldest")));
        EXPECT_THAT(ofCorners({corner(fate), young, young, young, young}).sentence, StartsWith("The oldest corner"));
    }
    EXPECT_THAT(ofCorners({corner(CornerFate::slow), young, young, young, young}).sentence,
                StartsWith("The fastest corner"));
}

TEST(ExplanationReasons, CornersThatMoveButAreNoVectorsDecideNothingByTheirFate) {
    const Explanation moving = ofCorners({corner(CornerFate::moving)});
    EXPECT_THAT(moving.sentence, StartsWith("No corner here moves enough to become a motion vector: motion.min_speed"));
    EXPECT_THAT(ofCorners({corner(CornerFate::moving), corner(CornerFate::moving), corner(CornerFate::slow)}).sentence,
                StartsWith("The fastest corner here"));
}

TEST(ExplanationReasons, OfCornersEquallyCloseTheFirstIsTold) {
    CornerVerdict second = corner(CornerFate::slow);
    second.parameter = "motion.sigma_factor";
    CornerVerdict first = corner(CornerFate::slow);
    first.parameter = "motion.min_speed";
    EXPECT_EQ(ofCorners({first, second}).parameter, "motion.min_speed");
    first.fate = second.fate = CornerFate::young;
    EXPECT_EQ(ofCorners({first, second}).parameter, "motion.min_speed");
}

TEST(ExplanationReasons, WithoutAScaleNothingIsToldInMetres) {
    SceneScale unknown = kScale;
    unknown.gsd_known = false;
    EXPECT_THAT(ofCorners({corner(CornerFate::slow)}, unknown).sentence,
                StartsWith("The fastest corner here moves 2 px/frame, 1 px/frame are needed"));
    EXPECT_THAT(linesOf(told(detected(), unknown), "detection"), Contains(EndsWith("a box of 18 px × 7 px")));
}

TEST(ExplanationReasons, CornersAreCountedUpToAPixelAroundThePlace) {
    PlaceEvidence evidence = test::emptyPlace();
    evidence.corners->resize(5, corner(CornerFate::slow));
    auto& corners = *evidence.corners;
    corners[0].position = {109.9F, 100};
    corners[1].position = {110.1F, 100};
    corners[2].position = {100, 90.1F};
    corners[3].position = {100, 89.9F};
    EXPECT_THAT(linesOf(told(evidence), "corners"), Contains("+ 3 corners here, 1000 in the frame"));
    evidence.corners.reset();
    for (const cv::Point2f& at : {cv::Point2f(109.9F, 100), cv::Point2f(110.1F, 100), cv::Point2f(100, 90.1F)})
        evidence.result.motion.stationary_corners.push_back(at);
    EXPECT_THAT(linesOf(told(evidence), "corners"), Contains("+ 2 corners here, 1000 in the frame"));
    evidence.result.motion.motion_vectors = detected().result.motion.motion_vectors;
    EXPECT_THAT(linesOf(told(evidence), "corners"), Contains("+ 6 corners here, 1000 in the frame"))
        << "what moves has corners, too";
    evidence.corners = CornerVerdicts{corner(CornerFate::moving)};
    EXPECT_THAT(linesOf(told(evidence), "corners"), Contains("+ 4 corners here, 1000 in the frame"));
    EXPECT_THAT(linesOf(told(evidence), "motion"), Contains("+ 4 motion vectors here"));
    evidence.corners->resize(5, corner(CornerFate::slow));
    EXPECT_THAT(linesOf(told(evidence), "corners"), Contains("+ 5 corners here, 1000 in the frame"));
}

TEST(ExplanationReasons, AClusterOverAPlainRoofHasAGap) {
    PlaceEvidence roof = withVectors({92, 92.5, 108, 108.5});
    for (std::size_t i = 2; i < 4; ++i) roof.result.motion.motion_vectors[i].position.x += 6;
    addCluster(roof, {0, 1, 2, 3});
    EXPECT_THAT(linesOf(told(roof), "clustering"),
                Contains(StartsWith("· front and rear of a plain roof: no standing corner in a gap of 21.5 px ahead")));
    PlaceEvidence linked = withVectors({92, 93, 106});
    addCluster(linked, {0, 1, 2});
    EXPECT_THAT(linesOf(told(linked), "clustering"),
                Contains(StartsWith("· held together at its weakest link by 13 px ahead")));
    PlaceEvidence single = withVectors({100});
    addCluster(single, {0});
    EXPECT_EQ(linesOf(told(single), "clustering").size(), 1U) << "nothing to be linked with";
}

TEST(ExplanationReasons, TheNextVectorMayBeTheFirstOfAll) {
    EXPECT_THAT(linesOf(told(withVectors({128, 98, 102})), "clustering"),
                ElementsAre(StartsWith("− 2 motion vectors are linked here"),
                            StartsWith("· the next vector is 26 px ahead and 0 px aside")));
}

TEST(ExplanationReasons, AClusterOfWhichNothingWasTracedWasNotSplit) {
    PlaceEvidence evidence = withVectors({94, 98, 102, 106, 112});
    addCluster(evidence, {0, 1, 2, 3});
    evidence.clustering.groups.resize(1);
    evidence.clustering.groups[0].cluster = 5;
    evidence.clustering.groups[0].split_by = "clustering.split_width";
    const Lines lines = linesOf(explain(evidence, test::withoutDensity(), kScale), "clustering");
    EXPECT_THAT(lines.back(), StartsWith("· the nearest vector outside is 6 px ahead"));
    EXPECT_THAT(lines.back(), EndsWith("@clustering.velocity_share")) << "of what it comes nearest to";
}

TEST(ExplanationReasons, OfLinkedVectorsTheClusterWithMostIsToldFirst) {
    PlaceEvidence evidence = withVectors({94, 98, 102, 106});
    addCluster(evidence, {0});
    addCluster(evidence, {1, 2, 3});
    const Lines lines = linesOf(told(evidence), "clustering");
    EXPECT_THAT(lines.front(), StartsWith("+ cluster 2: 3 motion vectors (3 are needed)"));
    EXPECT_THAT(lines.back(), testing::Eq("· the vectors here belong to 2 clusters @clustering.along"));
}

TEST(ExplanationReasons, PlacesOfChecksGoThroughTheMapOfTheSearchArea) {
    // In a search area that is seen turned and enlarged, (20, 10) is the middle of the place.
    const auto isTold = [](cv::Point2d at) {
        PlaceEvidence evidence = withVectors({94, 98, 102, 106});
        addCluster(evidence, {0, 1, 2, 3});
        SearchTrace search;
        search.roi.box = {{100, 100}, 30, 14, 0};
        search.roi.cluster = 0;
        search.roi.image_from_roi = {0.5, -1, 100, 1, 0.5, 75};
        search.trace.checks = {
            {"value", "gradient.min_box_area", 3, 4, false, false, {at.x - 0.1, at.y - 0.1, 0.2, 0.2}}};
        evidence.searches = {search};
        return linesOf(told(evidence), "detection").size() == 2;
    };
    // ½x − y and x + ½y − 25 within 9 px of 0.
    EXPECT_TRUE(isTold({20, 10}));
    EXPECT_TRUE(isTold({26, 12}));
    EXPECT_TRUE(isTold({12, 12}));
    EXPECT_TRUE(isTold({14, 5}));
    EXPECT_TRUE(isTold({25, 5}));
    EXPECT_FALSE(isTold({10, 9}));
    EXPECT_FALSE(isTold({29, 15}));
    EXPECT_FALSE(isTold({24, 1}));
    EXPECT_FALSE(isTold({19, 20}));
}

TEST(ExplanationReasons, ChecksThatEndedDifferentlyAreToldApart) {
    PlaceEvidence evidence = withVectors({94, 98, 102, 106});
    addCluster(evidence, {0, 1, 2, 3});
    SearchTrace search;
    search.roi.box = {{100, 100}, 30, 14, 0};
    search.roi.cluster = 0;
    search.trace.checks = {{"value", "gradient.min_box_area", 3, 4, false, false},
                           {"value", "gradient.min_box_area", 6, 4, false, true},
                           {"value", "gradient.min_box_area", 5, 4, false, true},
                           {"area", "gradient.min_box_area", 5, 4, false, true}};
    evidence.searches = {search};
    EXPECT_THAT(linesOf(told(evidence), "detection"),
                ElementsAre("− value: 3, at least 4 @gradient.min_box_area",
                            "+ value, 2 times: 5 … 6, at least 4 @gradient.min_box_area",
                            "+ area: 5, at least 4 @gradient.min_box_area", "− no box here"));
    EXPECT_THAT(linesOf(told(evidence), "search area"),
                ElementsAre("· 30 px (7.5 m) × 14 px (3.5 m) @detection.extend_along"));
    evidence.searches[0].roi.stack_layers = 1;
    EXPECT_THAT(linesOf(told(evidence), "search area"), ElementsAre(HasSubstr(", from a stack of 1 layers @")));
    // .5 is a half of one, .45 of 4 is nearer.
    evidence.searches[0].trace.checks = {{"value", "gradient.min_box_area", 2.2, 4, false, false},
                                         {"area", "gradient.support_share", 0, 0.5, false, false}};
    EXPECT_THAT(told(evidence).sentence, HasSubstr("closest was: value: 2.2, at least 4"));
}

TEST(ExplanationReasons, OnlyDetectionsOfTheClusterAtThePlaceCount) {
    PlaceEvidence evidence = detected();
    evidence.result.detections[0].box.centre = {140, 100};
    EXPECT_THAT(linesOf(told(evidence), "detection"), ElementsAre("− no box here"));
    evidence.result.detections.push_back(detected().result.detections[0]);
    EXPECT_EQ(linesOf(told(evidence), "detection").size(), 1U);
    EXPECT_THAT(linesOf(told(evidence), "removal"), ElementsAre(HasSubstr("4 motion vectors move with the box")));
}

TEST(ExplanationReasons, RemovalThatNothingExplainsIsToldInPlainWords) {
    PlaceEvidence evidence = detected();
    evidence.result.detections[0].rejection = Rejection::size;
    EXPECT_THAT(linesOf(told(evidence), "removal"), ElementsAre("− an impossible size of the box"));
    EXPECT_EQ(told(evidence).sentence, "The detection here has an impossible size.");
    EXPECT_EQ(told(evidence).rejection, Rejection::size);
    evidence.result.detections[0].rejection = Rejection::outlier;
    EXPECT_THAT(linesOf(told(evidence), "removal"), ElementsAre("− removed as an outlier"));
    EXPECT_EQ(told(evidence).sentence, "The detection here was removed as an outlier.");
    EXPECT_EQ(told(evidence).rejection, Rejection::outlier);
}

TEST(ExplanationReasons, TheCamerasOwnMotionIsToldFromATwentiethOfAPixelOn) {
    TrackEvidence judged;
    judged.detected = 0.5;
    judged.flow_ratio = 0.25;
    judged.alignment = 0.3;
    judged.flow_px = 0.049;
    EXPECT_THAT(scoreOf(judged), Contains(HasSubstr("the camera hardly moves there")));
    judged.flow_px = 0.051;
    EXPECT_THAT(scoreOf(judged), Contains(HasSubstr("over the ground it moves 0.25 times as fast as the ground")));
    EXPECT_THAT(scoreOf(judged), Contains(HasSubstr("73° off that direction: ")));
    judged.alignment = 1.2;
    EXPECT_THAT(scoreOf(judged), Contains(HasSubstr("), 0° off that direction; a standing thing")));
    judged.alignment = -1.2;
    EXPECT_THAT(scoreOf(judged), Contains(HasSubstr("), 180° off that direction: ")));
}

TEST(ExplanationReasons, PartsAndSumsAreToldToAHundredth) {
    TrackEvidence judged;
    judged.detected = 0.5;
    judged.decision = 4.56;
    judged.looked_alike = 0.25;
    judged.life_s = 30;
    const ScoreParts parts = partsOf(judged);
    judged.score = probabilityOf(judged) + 0.004;
    const Lines lines = scoreOf(judged);
    EXPECT_THAT(lines, Contains(HasSubstr("the classifier gives its boxes +4.56 on average")));
    // .643 ln(30.1 s).
    EXPECT_THAT(lines, Contains("+ it was followed for 30 s: speaks for a moving vehicle, +2.19"));
    EXPECT_NEAR(parts.life, 2.19, 0.005);
    EXPECT_THAT(lines.back(), EndsWith("(1 / (1 + exp(−sum)))"));
    judged.score = probabilityOf(judged) - 0.006;
    EXPECT_THAT(scoreOf(judged).back(), EndsWith("; the version of Eyrie that made the run weighed this differently"));
    judged.score = probabilityOf(judged) + 0.006;
    EXPECT_THAT(scoreOf(judged).back(), EndsWith("weighed this differently"));
}

TEST(ExplanationReasons, OnlyItsScoreFailsATrackThatWasLeftOutForIt) {
    PlaceEvidence evidence = detected();
    evidence.judged[7].score = 0.4;
    evidence.result.dropped = {{7, {{100, 100}, 18, 7, 0}, TrackDrop::hardly_detected, 0}};
    EXPECT_THAT(linesOf(told(evidence), "score").front(), StartsWith("· track 7 is a moving vehicle"));
    EXPECT_EQ(told(evidence).drop, TrackDrop::hardly_detected);
    evidence.result.dropped[0].why = TrackDrop::unlikely;
    EXPECT_THAT(linesOf(told(evidence), "score").front(), StartsWith("− track 7 is a moving vehicle"));
    evidence.judged.clear();
    EXPECT_THAT(linesOf(told(evidence), "score"), IsEmpty());
}

TEST(ExplanationReasons, WhatIsTentativeCountsItsDetectionsAlsoWhereTheRunHasIt) {
    PlaceEvidence evidence = detected();
    evidence.unfinished = {stateAt(8, 100, TrackStatus::tentative)};
    evidence.tracking->tentative = {{8, 3, 4, 5, 8}};
    evidence.result.tracks = {stateAt(9, 100, TrackStatus::tentative)};
    EXPECT_THAT(told(evidence).sentence,
                StartsWith("The track is tentative: detected in 3 of its last 4 frames, 5 within 8 are needed"));
    EXPECT_EQ(told(evidence).drop, TrackDrop::unconfirmed);
    EXPECT_THAT(linesOf(told(evidence), "tracks"), ElementsAre(StartsWith("− track is tentative: detected in 3")));
    evidence.result.tracks.clear();
    evidence.result.dropped = {{7, {{100, 100}, 18, 7, 0}, TrackDrop::hardly_detected, 0}};
    EXPECT_THAT(told(evidence).sentence, StartsWith("Left out when the run's tracks were finished: "));
}

TEST(ExplanationReasons, OfTracksLeftOutTheOneThatLiesBestIsTold) {
    PlaceEvidence evidence = detected();
    evidence.result.dropped = {{5, {{104, 100}, 18, 7, 0}, TrackDrop::hardly_detected, 0},
                               {6, {{100, 100}, 18, 7, 0}, TrackDrop::unlikely, 0},
                               {7, {{97, 100}, 18, 7, 0}, TrackDrop::hardly_detected, 0},
                               {8, {{200, 100}, 18, 7, 0}, TrackDrop::hardly_detected, 0}};
    EXPECT_EQ(told(evidence).drop, TrackDrop::unlikely);
    evidence.result.tracks = {stateAt(9, 105, TrackStatus::tentative)};
    EXPECT_EQ(told(evidence).drop, TrackDrop::unconfirmed) << "what the run has goes before what it left out";
    evidence.result.tracks = {stateAt(9, 105, TrackStatus::coasting)};
    EXPECT_TRUE(told(evidence).found);
    EXPECT_FALSE(told(evidence).drop.has_value());
}

TEST(ExplanationReasons, TracksThatEndElsewhereDoNotDecideHere) {
    PlaceEvidence evidence = detected();
    TracedTrack elsewhere;
    elsewhere.id = 4;
    elsewhere.predicted = {{300, 100}, 18, 7, 0};
    elsewhere.ended_by = "tracking.max_missing";
    evidence.tracking->tracks = {elsewhere};
    EXPECT_EQ(told(evidence).parameter, "tracking.split_merge");
    EXPECT_THAT(linesOf(told(evidence), "tracks"), ElementsAre("− no track here"));
    evidence.tracking->doubled = {{3, "tracking.duplicate_overlap"}};
    EXPECT_EQ(told(evidence).parameter, "tracking.split_merge") << "another detection starts no track";
    evidence.tracking->tracks[0].predicted.centre = {100, 100};
    EXPECT_EQ(told(evidence).parameter, "tracking.max_missing");
}

TEST(ExplanationReasons, ADetectionInATrackThatEndedNamesWhatEndedIt) {
    PlaceEvidence evidence = detected();
    TracedTrack owner;
    owner.id = 4;
    owner.predicted = {{300, 100}, 18, 7, 0};
    owner.kind = AssociationKind::matched;
    owner.detections = {0};
    owner.ended_by = "tracking.max_leaving";
    evidence.tracking->tracks = {owner};
    EXPECT_THAT(told(evidence).sentence, StartsWith("The detection here belongs to track 4, which lies elsewhere"));
    EXPECT_EQ(told(evidence).parameter, "tracking.max_leaving");
    evidence.unfinished = {stateAt(6, 100, TrackStatus::confirmed)};
    EXPECT_THAT(linesOf(told(evidence), "tracks").back(),
                testing::Eq("− joined or moved when the run's tracks were finished"));
}

}  // namespace eyrie::explanation_reasons_test
