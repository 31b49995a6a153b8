#include "explain/explanation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "explain/empty_place.h"
#include "tracking/finishing/track_score.h"

namespace eyrie::explanation_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

MotionVector vectorAt(CornerId id, float x, float y, cv::Point2f velocity = {2, 0}) {
    return {id, {x, y}, velocity, 20};
}

CornerVerdict cornerAt(CornerId id, float x, float y, CornerFate fate) {
    CornerVerdict corner;
    corner.id = id;
    corner.position = {x, y};
    corner.age = 20;
    corner.baseline = 12;
    corner.on_background = true;
    corner.fate = fate;
    return corner;
}

/// With what clustering reports of the frame.
Explanation explained(PlaceEvidence evidence, const ChainOptions& options, const SceneScale& scale) {
    MotionClustering(options.clustering, scale).cluster(evidence.result.motion, &evidence.clustering);
    return explain(evidence, options, scale);
}

/// The place with four vectors of one car in one cluster, which was searched.
PlaceEvidence clusteredPlace() {
    PlaceEvidence evidence = test::emptyPlace();
    FrameMotion& motion = evidence.result.motion;
    motion.motion_vectors = {vectorAt(1, 94, 98), vectorAt(2, 100, 98), vectorAt(3, 106, 98), vectorAt(4, 100, 102)};
    MotionCluster cluster;
    cluster.box = {{100, 100}, 13, 5, 0};
    cluster.velocity = {2, 0};
    cluster.members = {0, 1, 2, 3};
    evidence.result.clusters = {cluster};
    evidence.result.rois = {{{100, 100}, 30, 14, 0}};
    SearchTrace search;
    search.roi.box = {{100, 100}, 30, 14, 0};
    search.roi.cluster = 0;
    // Motion, along +x in the image, points up in the search area of 14 × 30 px.
    search.roi.image_from_roi = {0, -1, 114.5, 1, 0, 93.5};
    evidence.searches = {search};
    return evidence;
}

/// The same with a detection of the car.
PlaceEvidence detectedPlace() {
    PlaceEvidence evidence = clusteredPlace();
    Detection detection;
    detection.box = {{100, 100}, 18, 7, 0};
    detection.velocity = {2, 0};
    detection.cluster = 0;
    detection.vectors = {0, 1, 2, 3};
    evidence.result.detections = {detection};
    return evidence;
}

TrackState stateAt(TrackId id, cv::Point2d centre, TrackStatus status, StateOrigin origin) {
    TrackState state;
    state.id = id;
    state.box = {centre, 18, 7, 0};
    state.status = status;
    state.origin = origin;
    state.age = 9;
    state.hits = 3;
    return state;
}

TEST(Explanation, frameThatCouldNotBeRegistered) {
    PlaceEvidence evidence = test::emptyPlace();
    evidence.result.motion.registration.state = RegistrationState::failed;
    evidence.result.motion.registration.failure = {.fault = RegistrationFault::too_few_agree, .count = 12, .of = 40};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_FALSE(told.found);
    EXPECT_EQ(told.parameter, "registration.min_inliers");
    EXPECT_THAT(told.sentence, HasSubstr("too few corners agree (12 of 40)"));
    EXPECT_EQ(told.steps.front().verdict, StepVerdict::failed);
}

TEST(Explanation, placeWithoutCorners) {
    PlaceEvidence evidence = test::emptyPlace();
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(told.parameter, "registration.corner_deviation");
    EXPECT_EQ(told.setting, "0.5 px");
    evidence.result.motion.corner_count = 11'990;
    EXPECT_EQ(explained(evidence, test::withoutDensity(), test::kPlaceScale).parameter, "registration.max_corners");
}

TEST(Explanation, cornersTooYoungForTheirSpeedToBeKnown) {
    PlaceEvidence evidence = test::emptyPlace();
    CornerVerdict corner = cornerAt(1, 100, 100, CornerFate::young);
    corner.age = 3;
    corner.baseline = 0;
    corner.parameter = "motion.min_age";
    evidence.corners = CornerVerdicts{corner};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(told.parameter, "motion.min_age");
    EXPECT_EQ(told.sentence,
              "The oldest corner here has been tracked for 3 frames, 5 are needed: motion.min_age = 5 "
              "frames.");
}

TEST(Explanation, cornersSlowerThanTheThreshold) {
    PlaceEvidence evidence = test::emptyPlace();
    CornerVerdict corner = cornerAt(1, 100, 100, CornerFate::slow);
    corner.speed = 0.1;
    corner.limit = 0.16;
    corner.parameter = "motion.min_speed";
    CornerVerdict slower = corner;
    slower.id = 2;
    slower.speed = 0.04;
    evidence.corners = CornerVerdicts{corner, slower};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(told.parameter, "motion.min_speed");
    // 0.1 px/frame · 0.25 m/px · 25 frames/s = 0.625 m/s.
    EXPECT_EQ(told.sentence,
              "The fastest corner here moves 0.1 px/frame (0.625 m/s), 0.16 px/frame (1 m/s) are needed: "
              "motion.min_speed = 1 m/s.");
}

TEST(Explanation, cornersThatParallaxOrAShadowExplains) {
    PlaceEvidence evidence = test::emptyPlace();
    evidence.corners =
        CornerVerdicts{cornerAt(1, 98, 100, CornerFate::parallax), cornerAt(2, 102, 100, CornerFate::slow)};
    evidence.corners->front().parameter = "motion.parallax_factor";
    EXPECT_EQ(explained(evidence, test::withoutDensity(), test::kPlaceScale).parameter, "motion.parallax_factor");
    evidence.corners = CornerVerdicts{cornerAt(1, 98, 100, CornerFate::shadow)};
    EXPECT_EQ(explained(evidence, test::withoutDensity(), test::kPlaceScale).parameter, "motion.shadow_test");
}

TEST(Explanation, tooFewVectorsForACluster) {
    PlaceEvidence evidence = test::emptyPlace();
    evidence.result.motion.motion_vectors = {vectorAt(1, 98, 100), vectorAt(2, 102, 100)};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(told.sentence, "2 motion vectors, 3 are needed: clustering.min_members = 3 vectors.");
    ChainOptions by_density = test::withoutDensity();
    // 1000 corners in 1000 × 500 px give 0.002 per px²; a car of 18 × 7.2 px has 0.2592 of them, far below 3.
    by_density.clustering.min_density_share = 2;
    EXPECT_EQ(explained(evidence, by_density, test::kPlaceScale).parameter, "clustering.min_members");
    evidence.result.motion.corner_count = 10'000;  // 2.592 on a car, of which twice: 5
    const Explanation dense = explained(evidence, by_density, test::kPlaceScale);
    EXPECT_EQ(dense.sentence, "2 motion vectors, 5 are needed: clustering.min_density_share = 2.");
}

TEST(Explanation, vectorsThatTheLinkageKeepsApart) {
    PlaceEvidence evidence = test::emptyPlace();
    // Three vectors, one of them 6 px aside of the others, where 4 are allowed (1.0 m / 0.25 m/px).
    evidence.result.motion.motion_vectors = {vectorAt(1, 98, 98), vectorAt(2, 102, 98), vectorAt(3, 100, 104)};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(told.parameter, "clustering.min_distance");  // 1.0 m are 4 px, and so is the floor
    ChainOptions no_floor = test::withoutDensity();
    no_floor.clustering.min_distance = 1;
    EXPECT_EQ(explained(evidence, no_floor, test::kPlaceScale).parameter, "clustering.across");
    EXPECT_THAT(told.sentence, HasSubstr("3 motion vectors lie here, but only 2 are linked"));
    // Near enough, but half as fast: a difference of 1 px/frame, where 12 % of the mean of 1.5 are allowed.
    evidence.result.motion.motion_vectors[2] = vectorAt(3, 100, 100, {1, 0});
    const Explanation differs = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(differs.parameter, "clustering.velocity_share");
    EXPECT_THAT(differs.sentence, HasSubstr("velocities differ by 1 px/frame"));
    EXPECT_THAT(differs.sentence, HasSubstr("(allowed 0.18)"));
}

TEST(Explanation, clusterInWhichTheWindowsAreNotSureEnough) {
    PlaceEvidence evidence = clusteredPlace();
    evidence.searches.front().trace.checks = {
        {"decision value of the best window", "sliding_window.decision_threshold", -1.25, 0, false, false}};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(told.parameter, "sliding_window.decision_threshold");
    EXPECT_EQ(told.sentence,
              "The detector found no box here; closest was: decision value of the best window: -1.25, at least 0: "
              "sliding_window.decision_threshold = 0.");
}

TEST(Explanation, ofSeveralChecksTheOneThatWasCloserDecides) {
    PlaceEvidence evidence = clusteredPlace();
    const cv::Rect2d here(2.5, 5.5, 8, 18);
    evidence.searches.front().trace.checks = {
        {"motion vectors in a component", "gradient.support_share", 0, 1, false, false, here},
        {"area of a box", "gradient.min_box_area", 9, 10, false, false, here},
        {"area of a box", "gradient.min_box_area", 1, 10, false, false, {40, 60, 1, 1}}};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(told.parameter, "gradient.min_box_area");
    EXPECT_THAT(told.sentence, HasSubstr("area of a box: 9, at least 10"));
}

TEST(Explanation, detectionWithTooFewVectorsIsAnOutlier) {
    PlaceEvidence evidence = detectedPlace();
    evidence.result.detections.front().vectors = {0, 1};
    evidence.result.detections.front().rejection = Rejection::outlier;
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(told.sentence,
              "The detection here was removed as an outlier: 2 motion vectors move with the box, 3 are needed: "
              "outliers.min_vectors = 3 vectors.");
}

TEST(Explanation, detectionOfAnImpossibleSize) {
    PlaceEvidence evidence = detectedPlace();
    evidence.result.detections.front().box.length = 4;  // 1 m; at least 1.2 m are 4.8 px
    evidence.result.detections.front().rejection = Rejection::size;
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(told.parameter, "outliers.min_length");
    EXPECT_THAT(told.sentence, HasSubstr("4 px (1 m), at least 4.8 px (1.2 m)"));
}

TEST(Explanation, detectionThatReachesBeyondThePicture) {
    PlaceEvidence evidence = detectedPlace();
    evidence.result.motion.image_size = {104, 480};  // the box ends at x = 109, the picture at 103.5: 12.5 of 18 px
    evidence.result.detections.front().rejection = Rejection::size;
    ChainOptions options = test::withoutDensity();
    options.outliers.inside_image = true;
    const Explanation told = explained(evidence, options, test::kPlaceScale);
    EXPECT_EQ(told.parameter, "outliers.inside_image");
    EXPECT_THAT(told.sentence, HasSubstr("reaches beyond the picture: 69.4 % of the box is in the picture"));
}

TEST(Explanation, duplicateNamesTheOverlapThatDecided) {
    PlaceEvidence evidence = detectedPlace();
    evidence.result.detections.push_back(evidence.result.detections.front());
    evidence.result.detections[1].box.centre = {140, 100};
    evidence.result.detections[0].rejection = Rejection::duplicate;
    evidence.removal.duplicates = {{0, 1, 0.82, 0.7, "duplicates.threshold"}};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(told.parameter, "duplicates.threshold");
    EXPECT_THAT(told.sentence, HasSubstr("overlaps another detection by 0.82, duplicates overlap by 0.7"));
}

TEST(Explanation, tentativeTrackCountsItsDetections) {
    PlaceEvidence evidence = detectedPlace();
    evidence.tracking->started = {{0, 7}};
    evidence.unfinished = {stateAt(7, {100, 100}, TrackStatus::tentative, StateOrigin::detected)};
    evidence.tracking->tentative = {{7, 3, 8, 5, 8}};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_FALSE(told.found);
    EXPECT_EQ(
        told.sentence,
        "The track is tentative: detected in 3 of its last 8 frames, 5 within 8 are needed: tracking.confirm_hits = "
        "5 frames.");
    evidence.tracking->tentative = {{7, 1, 2, 4, 8, 1, 2}};
    EXPECT_EQ(explained(evidence, test::withoutDensity(), test::kPlaceScale).sentence,
              "The track is tentative: detected in 1 of its last 2 frames, 4 within 8 are needed, or 2 detections that "
              "look like a whole vehicle (so far 1): tracking.confirm_hits = 5 frames.");
}

TEST(Explanation, trackThatEndedForWantOfEvidence) {
    PlaceEvidence evidence = test::emptyPlace();
    TracedTrack track;
    track.id = 4;
    track.predicted = {{100, 100}, 18, 7, 0};
    track.ended_by = "tracking.max_missing";
    track.ended_value = 9;
    track.ended_limit = 8;
    evidence.tracking->tracks = {track};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    // The first thing that was missing decided: without a corner nothing else could come.
    EXPECT_EQ(told.parameter, "registration.corner_deviation");
    const auto ended = std::find_if(told.steps.begin(), told.steps.end(), [](const ExplanationStep& step) {
        return step.parameter == "tracking.max_missing";
    });
    ASSERT_NE(ended, told.steps.end());
    EXPECT_EQ(ended->verdict, StepVerdict::failed);
    EXPECT_EQ(ended->text, "track 4 ends: 9 against 8");
}

TEST(Explanation, detectionInsideATrackThatMovesAlikeStartsNone) {
    PlaceEvidence evidence = detectedPlace();
    evidence.tracking->doubled = {{0, "tracking.duplicate_overlap"}};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_EQ(told.parameter, "tracking.duplicate_overlap");
}

TEST(Explanation, hitTellsItsTrackAndTheRowOfTheOverlapMatrix) {
    PlaceEvidence evidence = detectedPlace();
    evidence.result.tracks = {stateAt(12, {100.5, 100}, TrackStatus::confirmed, StateOrigin::detected)};
    TracedTrack row;
    row.id = 12;
    row.predicted = {{100.5, 100}, 18, 7, 0};
    row.kind = AssociationKind::matched;
    row.detections = {0};
    evidence.tracking->tracks = {row};
    evidence.tracking->relations = {{0, 12, 0.93, true}};
    evidence.tracking->min_overlap = 0.2;
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_TRUE(told.found);
    EXPECT_TRUE(told.parameter.empty());
    EXPECT_THAT(told.sentence, StartsWith("Track 12 is here: confirmed"));
    const auto association = std::find_if(told.steps.begin(), told.steps.end(),
                                          [](const ExplanationStep& step) { return step.stage == "association"; });
    ASSERT_NE(association, told.steps.end());
    EXPECT_THAT(association->text, HasSubstr("track 12: matched, overlaps D1 0.93 ✓ (T_tov 0.2"));
    for (const ExplanationStep& step : told.steps) EXPECT_NE(step.verdict, StepVerdict::failed) << step.text;
}

TEST(Explanation, everyParameterNamedIsOneThatExists) {
    // What the sentences name is opened in the form, so each must be there.
    ChainOptions options;
    const auto declared = parameterValues(options);
    const auto exists = [&](const std::string& name) {
        return std::any_of(declared.begin(), declared.end(), [&](const auto& p) { return p.first == name; });
    };
    for (const char* name : {"registration.min_inliers",
                             "registration.inlier_distance",
                             "registration.corner_deviation",
                             "registration.max_corners",
                             "motion.min_age",
                             "motion.min_speed",
                             "motion.min_speed_px",
                             "motion.slow_min_speed",
                             "motion.sigma_factor",
                             "motion.max_speed",
                             "motion.parallax_factor",
                             "motion.shadow_test",
                             "motion.shadow_brightest",
                             "motion.method",
                             "clustering.min_members",
                             "clustering.min_density_share",
                             "clustering.along",
                             "clustering.across",
                             "clustering.min_distance",
                             "clustering.min_distance_far",
                             "clustering.velocity_share",
                             "clustering.velocity_floor",
                             "clustering.max_length",
                             "clustering.max_width",
                             "clustering.split_width",
                             "clustering.split_length",
                             "clustering.roof_length",
                             "detection.method",
                             "detection.extend_along",
                             "gradient.min_box_area",
                             "gradient.support_share",
                             "gradient.fall_back_share",
                             "sliding_window.decision_threshold",
                             "sliding_window.support_share",
                             "window_and_gradient.sure_decision",
                             "window_and_gradient.most_covered",
                             "duplicates.threshold",
                             "duplicates.part_car_length",
                             "duplicates.part_vehicle_length",
                             "outliers.min_vectors",
                             "outliers.min_density_share",
                             "outliers.min_area",
                             "outliers.min_length",
                             "outliers.max_length",
                             "outliers.max_width",
                             "outliers.inside_image",
                             "tracking.min_overlap",
                             "tracking.confirm_hits",
                             "tracking.max_missing",
                             "tracking.max_missing_tentative",
                             "tracking.max_stopped",
                             "tracking.max_leaving",
                             "tracking.min_visible",
                             "tracking.duplicate_overlap",
                             "tracking.duplicate_containment",
                             "tracking.one_vehicle",
                             "tracking.suppress_duplicates",
                             "tracking.split_merge",
                             "finishing.trim_predicted",
                             "finishing.max_sharing",
                             "finishing.drop_shadows",
                             "finishing.min_detected",
                             "finishing.min_length"})
        EXPECT_TRUE(exists(name)) << name;
}

TEST(Explanation, trackLeftOutWhenTracksWereFinished) {
    PlaceEvidence evidence = detectedPlace();
    evidence.result.dropped = {{7, {{100, 100}, 18, 7, 0}, TrackDrop::hardly_detected, 0}};
    const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
    EXPECT_FALSE(told.found);
    EXPECT_EQ(told.parameter, "finishing.min_detected");
    EXPECT_THAT(told.sentence, HasSubstr("track 7 was guessed rather than detected"));
}

TEST(Explanation, whatSpeaksForATrackAndAgainstItIsTold) {
    PlaceEvidence evidence = detectedPlace();
    evidence.result.tracks = {stateAt(7, {100, 100}, TrackStatus::confirmed, StateOrigin::detected)};
    TrackEvidence judged;
    judged.detected = 0.9;
    judged.looked_alike = 0.25;
    judged.decision = 4;
    judged.life_s = 4;
    judged.flow_px = 2;
    judged.flow_ratio = 0.2;
    judged.alignment = 0.99;
    judged.score = 0.91;
    evidence.judged[7] = judged;
    const auto stepWith = [&](const std::string& words) {
        const Explanation told = explained(evidence, test::withoutDensity(), test::kPlaceScale);
        for (const ExplanationStep& step : told.steps)
            if (step.text.find(words) != std::string::npos) return step;
        return ExplanationStep{};
    };
    EXPECT_EQ(stepWith("probability of 0.91, at least").parameter, "finishing.min_score");
    EXPECT_EQ(stepWith("probability of 0.91, at least").verdict, StepVerdict::passed);
    EXPECT_THAT(stepWith("found as a whole vehicle in 25 % of its detections").text, HasSubstr("speaks for a moving"));
    EXPECT_THAT(stepWith("detected in 90 % of its frames").text, HasSubstr("speaks for a moving"));
    EXPECT_THAT(stepWith("0.2 times as fast as the ground").text, HasSubstr("speaks against it, −"));
    evidence.judged[7].score = 0.5;
    EXPECT_THAT(stepWith("which is a probability of").text, HasSubstr("that made the run weighed this differently"));
    evidence.judged[7].score = probabilityOf(judged);
    EXPECT_THAT(stepWith("which is a probability of").text, testing::EndsWith("(1 / (1 + exp(−sum)))"));
    EXPECT_FALSE(stepWith("a standing thing would have to be 0.165 of the flight height tall").text.empty());

    evidence.result.tracks.clear();
    evidence.result.dropped = {{7, {{100, 100}, 18, 7, 0}, TrackDrop::unlikely, 0}};
    evidence.judged[7].score = 0.01;
    EXPECT_EQ(stepWith("probability of 0.01, at least").verdict, StepVerdict::failed);
    EXPECT_FALSE(stepWith("detected in 90 % of its frames").text.empty());
}

}  // namespace
}  // namespace eyrie::explanation_test
