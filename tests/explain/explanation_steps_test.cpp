/// Every step that is told of a place, in order, with its verdict and the parameter that it names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "explain/empty_place.h"

namespace eyrie::explanation_steps_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Lines = std::vector<std::string>;

const SceneScale kScale = test::kPlaceScale;  // a car is 18 px long, 1 px/frame are 6.25 m/s

void addVectors(PlaceEvidence& evidence, const std::vector<cv::Point2f>& places) {
    for (const cv::Point2f& at : places) {
        auto& vectors = evidence.result.motion.motion_vectors;
        vectors.push_back({static_cast<CornerId>(vectors.size()), at, {2, 0}, 20});
    }
}

void addCluster(PlaceEvidence& evidence, std::vector<int> members, const OrientedBox& box = {{100, 100}, 13, 5, 0}) {
    MotionCluster cluster;
    cluster.box = box;
    cluster.members = std::move(members);
    evidence.result.clusters.push_back(cluster);
}

/// Four vectors of one car in one cluster.
PlaceEvidence clustered() {
    PlaceEvidence evidence = test::emptyPlace();
    addVectors(evidence, {{94, 98}, {100, 98}, {106, 98}, {100, 102}});
    addCluster(evidence, {0, 1, 2, 3});
    return evidence;
}

Detection detectionAt(double x, Rejection rejection = Rejection::none) {
    Detection detection;
    detection.box = {{x, 100}, 18, 7, 0};
    detection.cluster = 0;
    detection.vectors = {0, 1, 2, 3};
    detection.rejection = rejection;
    return detection;
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

Explanation told(PlaceEvidence evidence, const ChainOptions& options = test::withoutDensity()) {
    MotionClustering(options.clustering, kScale).cluster(evidence.result.motion, &evidence.clustering);
    return explain(evidence, options, kScale);
}

/// The steps of a stage, or of all: "+ passed", "− failed" or "· note", and the parameter behind an @.
Lines linesOf(const Explanation& explanation, const std::string& stage = {}) {
    Lines lines;
    for (const ExplanationStep& step : explanation.steps) {
        if (!stage.empty() && step.stage != stage) continue;
        const std::string mark = step.verdict == StepVerdict::passed   ? "+ "
                                 : step.verdict == StepVerdict::failed ? "− "
                                                                       : "· ";
        lines.push_back(mark + (stage.empty() ? step.stage + ": " : "") + step.text +
                        (step.parameter.empty() ? "" : " @" + step.parameter));
    }
    return lines;
}

CornerVerdict corner(CornerFate fate, double speed, double limit, int baseline, const std::string& parameter = {}) {
    CornerVerdict verdict;
    verdict.position = {100, 100};
    verdict.fate = fate;
    verdict.age = baseline > 0 ? 20 : 2;
    verdict.speed = speed;
    verdict.limit = limit;
    verdict.baseline = baseline;
    verdict.on_background = fate == CornerFate::slow;
    verdict.parameter = parameter;
    return verdict;
}

TEST(ExplanationSteps, EndWhereNothingGoesOn) {
    EXPECT_THAT(
        linesOf(told(test::emptyPlace())),
        ElementsAre("+ registration: 800 corners agree, 0.2 px rms @registration.min_inliers",
                    "− corners: no corner was tracked here @registration.corner_deviation", "− tracks: no track here"));
    PlaceEvidence slow = test::emptyPlace();
    slow.corners = {corner(CornerFate::slow, 0.1, 0.16, 12, "motion.min_speed")};
    EXPECT_THAT(linesOf(told(slow)),
                ElementsAre("+ registration: 800 corners agree, 0.2 px rms @registration.min_inliers",
                            "+ corners: 1 corner here, 1000 in the frame",
                            "· corners: 1 corner agrees with the ground's homography (RANSAC), 0 do not "
                            "@registration.inlier_distance",
                            "+ motion: the oldest of 1 corner has been tracked 20 frames, 5 are needed @motion.min_age",
                            "· motion: 1 corner is too slow: fastest 0.1 px/frame (0.625 m/s), threshold 0.16 px/frame "
                            "(1 m/s) over 12 frames @motion.min_speed",
                            "− motion: no motion vector here", "− tracks: no track here"));
    PlaceEvidence first = test::emptyPlace();
    first.result.motion.registration.state = RegistrationState::first;
    EXPECT_THAT(linesOf(told(first)),
                ElementsAre("− registration: the first frame of the run: there is nothing to register it onto",
                            "− tracks: no track here"));
    PlaceEvidence frozen = clustered();
    frozen.result.motion.registration.state = RegistrationState::frozen;
    EXPECT_THAT(linesOf(told(frozen), "registration"),
                ElementsAre("· the picture repeats the one before; nothing moves in it"));
    EXPECT_THAT(linesOf(told(frozen), "clustering"), Not(IsEmpty())) << "it goes on";
}

TEST(ExplanationSteps, CornersAreToldByTheirFate) {
    PlaceEvidence evidence = test::emptyPlace();
    evidence.corners = {corner(CornerFate::young, 0, 0, 0, "motion.min_age"),
                        corner(CornerFate::young, 0, 0, 0, "motion.min_age"), corner(CornerFate::moving, 2, 0.2, 12),
                        corner(CornerFate::too_fast, 20, 10, 12, "motion.max_speed"),
                        corner(CornerFate::shadow, 1, 0.2, 12, "motion.shadow_test")};
    evidence.corners->push_back(corner(CornerFate::parallax, 1, 0.2, 12, "motion.parallax_factor"));
    evidence.corners->back().position = {300, 300};  // elsewhere
    EXPECT_THAT(linesOf(told(evidence), "motion"),
                ElementsAre("+ the oldest of 5 corners has been tracked 20 frames, 5 are needed @motion.min_age",
                            "+ 1 corner is moving: fastest 2 px/frame (12.5 m/s), threshold 0.2 px/frame (1.25 m/s) "
                            "over 12 frames @motion.min_speed",
                            "· 2 corners are too young @motion.min_age",
                            "· 1 corner is too fast: fastest 20 px/frame (125 m/s), threshold 10 px/frame (62.5 m/s) "
                            "over 12 frames @motion.max_speed",
                            "· 1 corner is on a shadow: fastest 1 px/frame (6.25 m/s), threshold 0.2 px/frame "
                            "(1.25 m/s) over 12 frames @motion.shadow_test",
                            "− no motion vector here"));
    evidence.corners = {corner(CornerFate::young, 0, 0, 0, "motion.min_age")};
    EXPECT_THAT(linesOf(told(evidence), "motion"),
                Contains("− the oldest of 1 corner has been tracked 2 frames, 5 are needed @motion.min_age"));
}

TEST(ExplanationSteps, OneSlowCornerDecidesAmongManyYoungOnesButOneOnAShadowDoesNot) {
    const CornerVerdict young = corner(CornerFate::young, 0, 0, 0, "motion.min_age");
    PlaceEvidence evidence = test::emptyPlace();
    evidence.corners = {young, young, young, young, corner(CornerFate::slow, 0.1, 0.16, 12, "motion.min_speed")};
    EXPECT_EQ(told(evidence).parameter, "motion.min_speed");
    for (const CornerFate outweighed : {CornerFate::shadow, CornerFate::parallax, CornerFate::too_fast}) {
        evidence.corners->back() = corner(outweighed, 2, 1, 12, "it.decided");
        EXPECT_EQ(told(evidence).parameter, "motion.min_age");
        evidence.corners->erase(evidence.corners->begin());
        EXPECT_EQ(told(evidence).parameter, outweighed == CornerFate::shadow ? "motion.shadow_test" : "it.decided");
        evidence.corners->insert(evidence.corners->begin(), young);
    }
}

TEST(ExplanationSteps, WithoutVerdictsStandingCornersAreCounted) {
    PlaceEvidence evidence = test::emptyPlace();
    evidence.corners.reset();
    evidence.result.motion.stationary_corners = {{95, 100}, {105, 100}, {300, 100}};
    const Explanation explanation = told(evidence);
    EXPECT_THAT(linesOf(explanation, "corners"), ElementsAre("+ 2 corners here, 1000 in the frame"));
    EXPECT_EQ(explanation.parameter, "motion.min_speed");
}

TEST(ExplanationSteps, TooFewVectorsAndTheNextOfThem) {
    PlaceEvidence evidence = test::emptyPlace();
    addVectors(evidence, {{98, 100}, {102, 100}, {128, 100}});
    const std::string linked = "− 2 motion vectors are linked here, 3 are needed @clustering.min_members";
    EXPECT_THAT(linesOf(told(evidence), "clustering"),
                ElementsAre(linked,
                            "· the next vector is 26 px ahead and 0 px aside (linkage 14 × 4 px), velocities "
                            "differ by 0 px/frame (0 m/s) (allowed 0.24) @clustering.along"));
    evidence.result.motion.motion_vectors[2].position.x = 102 + 141;
    EXPECT_THAT(linesOf(told(evidence), "clustering"), ElementsAre(linked)) << "ten linkage distances are far";
    evidence.result.motion.motion_vectors.pop_back();
    EXPECT_THAT(linesOf(told(evidence), "clustering"), ElementsAre(linked)) << "there is no other";
    PlaceEvidence sideways = test::emptyPlace();
    addVectors(sideways, {{98, 96}, {102, 96}, {100, 104}});
    EXPECT_THAT(told(sideways).sentence,
                HasSubstr("3 motion vectors lie here, but only 2 are linked: the next is 2 px ahead and 8 px aside"));
}

TEST(ExplanationSteps, LinkedVectorsThatAreTooLong) {
    PlaceEvidence evidence = test::emptyPlace();
    addVectors(evidence, {{92, 100}, {100, 100}, {108, 100}});
    ChainOptions options = test::withoutDensity();
    options.clustering.max_length_m = 3;
    const Explanation explanation = told(evidence, options);
    EXPECT_THAT(linesOf(explanation, "clustering"),
                ElementsAre("+ 3 motion vectors are linked here, 3 are needed @clustering.min_members",
                            "− the vectors linked here are 17 px (4.25 m) long, 12 px (3 m) are allowed "
                            "@clustering.max_length"));
    EXPECT_EQ(explanation.sentence,
              "The vectors linked here are 17 px (4.25 m) long, 12 px (3 m) are allowed: clustering.max_length = 3 m.");
}

TEST(ExplanationSteps, AClusterIsToldWithItsWeakestLinkAndItsNearestNeighbour) {
    PlaceEvidence evidence = clustered();
    const std::string inside =
        "· held together at its weakest link by 0 px ahead and 4 px aside (linkage 14 × 4 px), velocities differ by "
        "0 px/frame (0 m/s) (allowed 0.24) @clustering.across";
    const std::string cluster =
        "+ cluster 1: 4 motion vectors (3 are needed), 13 px (3.25 m) × 5 px (1.25 m) @clustering.min_members";
    EXPECT_THAT(linesOf(told(evidence), "clustering"), ElementsAre(cluster, inside)) << "no vector is outside";
    addVectors(evidence, {{106 + 28, 98}});
    EXPECT_THAT(linesOf(told(evidence), "clustering"),
                ElementsAre(cluster, inside,
                            "· the nearest vector outside is 28 px ahead and 0 px aside (linkage 14 × 4 px), "
                            "velocities differ by 0 px/frame (0 m/s) (allowed 0.24) @clustering.along"));
    evidence.result.motion.motion_vectors.back().position.x = 106 + 57;
    EXPECT_THAT(linesOf(told(evidence), "clustering"), ElementsAre(cluster, inside)) << "four linkage distances";
    PlaceEvidence first = test::emptyPlace();
    addVectors(first, {{106 + 28, 98}, {94, 98}, {100, 98}, {106, 98}, {100, 102}});
    addCluster(first, {1, 2, 3, 4});
    EXPECT_EQ(linesOf(told(first), "clustering").size(), 3U) << "the neighbour may be the first of all vectors";
}

TEST(ExplanationSteps, AClusterThatWasSplitSaysSo) {
    PlaceEvidence evidence = clustered();
    addVectors(evidence, {{112, 98}});
    evidence.clustering.groups.resize(2);
    evidence.clustering.groups[0].members = {4};
    evidence.clustering.groups[1].members = {0, 1, 2, 3};
    evidence.clustering.groups[1].cluster = 0;
    evidence.clustering.groups[1].split_by = "clustering.split_width";
    const auto neighbour = [&] {
        return linesOf(explain(evidence, test::withoutDensity(), kScale), "clustering").back();
    };
    EXPECT_THAT(neighbour(), HasSubstr("; they came apart when a cluster that was too large was split"));
    EXPECT_THAT(neighbour(), testing::EndsWith("@clustering.split_width"));
    evidence.result.motion.motion_vectors[4].position.x = 134;
    EXPECT_THAT(neighbour(), testing::EndsWith("@clustering.along")) << "it was never linked";
    evidence.result.motion.motion_vectors[4].position.x = 112;
    evidence.clustering.groups[1].split_by.clear();
    EXPECT_THAT(neighbour(), Not(HasSubstr("split")));
}

TEST(ExplanationSteps, AreasOfDifferenceImagesAreAllTold) {
    ChainOptions options = test::withoutDensity();
    options.difference.method = MotionMethod::two_frame_difference;
    PlaceEvidence evidence = clustered();
    addVectors(evidence, {{100, 106}});
    addCluster(evidence, {4}, {{100, 106}, 3, 3, 0});
    EXPECT_THAT(linesOf(told(evidence, options), "clustering"),
                ElementsAre("+ cluster 1: 4 motion vectors, 13 px (3.25 m) × 5 px (1.25 m) @motion.method",
                            "+ cluster 2: 1 motion vector, 3 px (0.75 m) × 3 px (0.75 m) @motion.method",
                            "· the vectors here belong to 2 clusters"));
    evidence.result.clusters.clear();
    EXPECT_EQ(told(evidence, options).parameter, "motion.method");
    EXPECT_THAT(linesOf(told(evidence, options), "detection"), IsEmpty());
    PlaceEvidence still = test::emptyPlace();
    still.corners = {corner(CornerFate::slow, 0.1, 0.16, 12, "motion.min_speed")};
    EXPECT_EQ(told(still, options).parameter, "motion.method") << "no vector is needed";
}

TEST(ExplanationSteps, SearchAreasOfOtherClustersDoNotConcernThePlace) {
    PlaceEvidence evidence = clustered();
    SearchTrace search;
    search.roi.box = {{100, 100}, 30, 14, 0};
    search.roi.cluster = 3;
    search.trace.checks = {{"value", "far.away", 1, 4, false, false}};
    SearchTrace stacked = search;
    stacked.roi.cluster = 0;
    stacked.roi.stack_layers = 7;
    stacked.trace.checks = {{"value", "sliding_window.decision_threshold", 5, 4, false, true}};
    evidence.searches = {search, stacked};
    const Explanation explanation = told(evidence);
    EXPECT_THAT(linesOf(explanation, "search area"),
                ElementsAre("· 30 px (7.5 m) × 14 px (3.5 m), from a stack of 7 layers @detection.extend_along"));
    EXPECT_THAT(linesOf(explanation, "detection"),
                ElementsAre("+ value: 5, at least 4 @sliding_window.decision_threshold", "− no box here"));
    EXPECT_EQ(explanation.parameter, "detection.method");
    evidence.searches[1].trace.checks.push_back({"area", "gradient.min_box_area", 9, 10, false, false});
    evidence.result.detections = {detectionAt(100)};
    EXPECT_THAT(linesOf(told(evidence), "detection"),
                ElementsAre("+ value: 5, at least 4 @sliding_window.decision_threshold",
                            "· area: 9, at least 10 @gradient.min_box_area",
                            "+ window_and_gradient delivers a box of 18 px (4.5 m) × 7 px (1.75 m)"));
    evidence.result.detections[0].cluster = 1;
    EXPECT_THAT(linesOf(told(evidence), "detection"), Contains("− no box here")) << "it is another cluster's";
}

TEST(ExplanationSteps, RemovedDetectionsAreToldBesideTheOneThatStayed) {
    PlaceEvidence evidence = clustered();
    evidence.result.detections = {detectionAt(100), detectionAt(102, Rejection::duplicate),
                                  detectionAt(98, Rejection::outlier)};
    evidence.result.detections[0].probability = 0.75;
    evidence.result.detections[2].vectors = {0, 1};
    evidence.removal.duplicates = {{1, 0, 0.82, 0.7, "duplicates.threshold"}};
    EXPECT_THAT(linesOf(told(evidence), "removal"),
                ElementsAre("+ 4 motion vectors move with the box, 3 are needed @outliers.min_vectors",
                            "· a moving vehicle with a probability of 0.75, by this frame alone",
                            "· removed as a duplicate: overlaps another detection by 0.82, duplicates overlap by 0.7 "
                            "@duplicates.threshold",
                            "− 2 motion vectors move with the box, 3 are needed @outliers.min_vectors"));
    EXPECT_FALSE(told(evidence).rejection.has_value());
}

TEST(ExplanationSteps, OfRemovedDetectionsTheOneThatLiesBestDecides) {
    PlaceEvidence evidence = clustered();
    evidence.result.detections = {detectionAt(106, Rejection::outlier), detectionAt(93, Rejection::outlier),
                                  detectionAt(100, Rejection::duplicate)};
    for (const int i : {0, 1}) evidence.result.detections[static_cast<std::size_t>(i)].vectors = {0, 1};
    evidence.removal.duplicates = {{0, 1, 0.9, 0.7, "duplicates.threshold"},
                                   {2, 0, 17, 18, "duplicates.part_car_length"}};
    const Explanation explanation = told(evidence);
    EXPECT_EQ(explanation.rejection, Rejection::duplicate);
    EXPECT_THAT(explanation.sentence,
                HasSubstr("joined with another part of a vehicle: together 17 px (4.25 m) long, up to 18 px (4.5 m)"));
    EXPECT_EQ(linesOf(explanation, "removal").size(), 3U);
    evidence.removal.duplicates.clear();
    EXPECT_THAT(told(evidence).sentence, HasSubstr("The detection here was removed as a duplicate of another"));
    evidence.result.detections[2].box.centre.x = 88;
    EXPECT_EQ(told(evidence).rejection, Rejection::outlier);
}

TEST(ExplanationSteps, RowsOfTracksThatThePlaceConcerns) {
    PlaceEvidence evidence = clustered();
    evidence.result.detections = {detectionAt(100)};
    TracedTrack here, claiming, elsewhere;
    here.id = 3;
    here.predicted = {{104, 100}, 18, 7, 0};
    here.gate_px = 2.5;
    here.ended_by = "tracking.max_missing";
    here.ended_value = 9;
    here.ended_limit = 8;
    claiming.id = 4;
    claiming.predicted = {{300, 100}, 18, 7, 0};
    claiming.kind = AssociationKind::matched;
    claiming.detections = {0};
    elsewhere.id = 5;
    elsewhere.predicted = {{300, 100}, 18, 7, 0};
    evidence.tracking->tracks = {here, elsewhere, claiming};
    evidence.tracking->relations = {{0, 3, 0.1, false}, {0, 4, 0.5, true}, {7, 4, 0.25, false}, {6, 5, 0.4, true}};
    evidence.tracking->min_overlap = 0.2;
    EXPECT_THAT(linesOf(told(evidence), "association"),
                ElementsAre("· track 3: no detection, overlaps D1 0.1 ✗ (T_tov 0.2, gate 2.5 px) @tracking.min_overlap",
                            "+ track 4: matched, overlaps D1 0.5 ✓, D8 0.25 ✗ (T_tov 0.2, gate 0 px) "
                            "@tracking.min_overlap"));
    EXPECT_THAT(linesOf(told(evidence), "tracks"),
                ElementsAre("− track 3 ends: 9 against 8 @tracking.max_missing", "− no track here"));
    EXPECT_EQ(told(evidence).sentence,
              "Track 3 ended here: 9 frames without evidence, at most 8 are allowed: tracking.max_missing = 0.3 s.");
    evidence.tracking->tracks[0].ended_by = "tracking.min_visible";
    EXPECT_THAT(told(evidence).sentence,
                HasSubstr("Track 3 ended here: 9 of its box is in the picture, more than 8 is needed: "));
    evidence.tracking->tracks[0].ended_by = "tracking.suppress_duplicates";
    EXPECT_THAT(linesOf(told(evidence), "tracks"),
                Contains("− track 3 ends: it lies on another that moves alike @tracking.suppress_duplicates"));
    EXPECT_EQ(told(evidence).sentence, "The detection here belongs to track 4, which lies elsewhere.");
    evidence.tracking->tracks[2].detections = {0, 7};
    EXPECT_EQ(told(evidence).parameter, "tracking.split_merge") << "it is one of the parts of another";
    evidence.tracking->tracks[2].detections = {7};
    EXPECT_EQ(told(evidence).parameter, "tracking.split_merge");
    evidence.tracking->tracks[2].detections = {0};
    evidence.tracking->tracks[2].kind = AssociationKind::merged;
    EXPECT_EQ(told(evidence).parameter, "tracking.split_merge");
}

TEST(ExplanationSteps, WhatBecameOfTheTrackersOwnTrack) {
    PlaceEvidence evidence = clustered();
    evidence.result.detections = {detectionAt(100)};
    evidence.unfinished = {stateAt(6, 100, TrackStatus::confirmed, StateOrigin::predicted),
                           stateAt(8, 300, TrackStatus::tentative)};
    ChainOptions options = test::withoutDensity();
    options.finishing.trim_predicted = true;
    EXPECT_THAT(linesOf(told(evidence, options), "tracks"),
                ElementsAre("+ track 6 of the tracker: confirmed, predicted",
                            "− removed when the run's tracks were finished @finishing.trim_predicted"));
    EXPECT_EQ(told(evidence, options).parameter, "finishing.trim_predicted");
    options.finishing.trim_predicted = false;
    EXPECT_THAT(linesOf(told(evidence, options), "tracks"),
                ElementsAre("+ track 6 of the tracker: confirmed, predicted",
                            "− joined or moved when the run's tracks were finished"));
    evidence.tracking->started = {{0, 8}};
    evidence.tracking->tentative = {{5, 9, 9, 9, 9}, {8, 1, 1, 5, 8}};
    const Explanation tentative = told(evidence, options);
    EXPECT_THAT(linesOf(tentative, "tracks"),
                ElementsAre("− track is tentative: detected in 1 of its last 1 frame, 5 within 8 are needed "
                            "@tracking.confirm_hits"))
        << "the track that the detection here started";
    EXPECT_EQ(tentative.drop, TrackDrop::unconfirmed);
    evidence.tracking->started = {{3, 8}};
    EXPECT_THAT(linesOf(told(evidence, options), "tracks"), Contains(HasSubstr("track 6 of the tracker")));
    evidence.tracking.reset();
    EXPECT_THAT(linesOf(told(evidence, options), "tracks"), ElementsAre("− no track here"));
    EXPECT_EQ(told(evidence, options).sentence, "No track here.");
}

TEST(ExplanationSteps, ATentativeTrackOfTheRunIsLeftOut) {
    PlaceEvidence evidence = clustered();
    evidence.result.detections = {detectionAt(100)};
    evidence.result.tracks = {stateAt(9, 104, TrackStatus::tentative)};
    const Explanation explanation = told(evidence);
    EXPECT_FALSE(explanation.found);
    EXPECT_EQ(explanation.drop, TrackDrop::unconfirmed);
    EXPECT_THAT(linesOf(explanation, "tracks"), ElementsAre("− track 9 was never confirmed @tracking.confirm_hits"));
    evidence.tracking.reset();
    EXPECT_THAT(linesOf(told(evidence), "tracks"), ElementsAre("− track 9 was never confirmed @tracking.confirm_hits"));
}

TEST(ExplanationSteps, ATrackWithoutADetectionSaysWhatIsMissing) {
    PlaceEvidence evidence = test::emptyPlace();
    evidence.result.tracks = {stateAt(9, 104, TrackStatus::coasting, StateOrigin::predicted),
                              stateAt(2, 100, TrackStatus::confirmed, StateOrigin::reconstructed)};
    const Explanation explanation = told(evidence);
    EXPECT_TRUE(explanation.found);
    EXPECT_THAT(explanation.sentence,
                testing::StartsWith("Track 2 is here: confirmed, reconstructed, but without a detection of its own in "
                                    "this frame. No corner was tracked here"));
    EXPECT_EQ(explanation.parameter, "registration.corner_deviation");
    EXPECT_THAT(linesOf(explanation, "tracks"),
                ElementsAre("+ track 2: confirmed, reconstructed, detected in 3 of 10 frames"));
}

}  // namespace
TEST(ExplanationSteps, AShadowThatWasLeftOutIsToldWithItsVehicleAndWhereShadowsFall) {
    PlaceEvidence evidence = clustered();
    evidence.result.dropped = {{7, {{100, 100}, 18, 7, 0}, TrackDrop::shadow, 3}};
    EXPECT_THAT(linesOf(told(evidence), "tracks"), Not(Contains(HasSubstr("shadows fall"))));
    evidence.shadow = FrameShadow{0, 0, 6};
    const Explanation explanation = told(evidence);
    EXPECT_THAT(explanation.sentence, HasSubstr("track 7 drives beside track 3"));
    EXPECT_EQ(explanation.drop, TrackDrop::shadow);
    EXPECT_THAT(linesOf(explanation, "tracks"),
                Contains("· shadows fall to 0° (to the right), 1.5 m beyond most vehicles in this frame "
                         "@finishing.drop_shadows"));
    evidence.result.dropped[0].why = TrackDrop::unlikely;
    EXPECT_THAT(linesOf(told(evidence), "tracks"), Not(Contains(HasSubstr("shadows fall"))));
}

TEST(ExplanationSteps, WhatWasTakenOutOfTheBoxesOfATrackIsTold) {
    PlaceEvidence evidence = clustered();
    evidence.result.tracks = {stateAt(4, 100, TrackStatus::confirmed)};
    evidence.shadow = FrameShadow{0, 0, 6};
    evidence.trims[5] = {LightOutcome::shadows, 0.5, 0.5, 0.2};
    EXPECT_THAT(linesOf(told(evidence), "tracks"), Not(Contains(HasSubstr("taken out of its boxes"))));
    evidence.trims[4] = {LightOutcome::beams, 0.3, 0, 0.3};
    EXPECT_THAT(linesOf(told(evidence), "tracks"),
                Contains("· what its headlights light was taken out of its boxes: 30 % of their area "
                         "@finishing.trim_shadows"));
}

}  // namespace eyrie::explanation_steps_test
