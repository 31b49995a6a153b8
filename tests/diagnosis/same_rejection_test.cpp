#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "chain/parameter_stage.h"
#include "diagnosis/hindered_run.h"
#include "motion/clusters/place_contents.h"
#include "removal/rejection_counts.h"

/// What detection, removal, tracking and finishing leave out is told alike by Why?, by Stages and by the list of
/// errors.
namespace eyrie::same_rejection_test {
namespace {

using test::HinderedRun;
using testing::HasSubstr;

/// Nothing but sizes counts.
ChainOptions sizesAlone() {
    ChainOptions options;
    options.outliers.min_vectors = 0;
    options.outliers.min_density_share = 0;
    options.outliers.min_area = 0;
    options.outliers.min_length_m = 0;
    options.outliers.max_length_m = 0;
    options.outliers.max_width_m = 0;
    return options;
}

/// Finishing that drops nothing that was confirmed.
ChainOptions nothingDropped() {
    ChainOptions options;
    options.finishing.min_length_m = 0;
    options.finishing.min_width_m = 0;
    options.finishing.max_aspect = 0;
    options.finishing.max_sharing = 1;
    options.finishing.drop_shadows = false;
    options.finishing.min_detected = 0;
    options.finishing.standing_height = 0;
    options.finishing.roof_height = 0;
    options.finishing.standing_depth = 0;
    options.finishing.min_score = 0;
    return options;
}

std::string named(const std::string& parameter) {
    return "(" + parameter + ")";
}

TEST(SameRejection, ADetectorThatPutsNoBoxThere) {
    ChainOptions options;
    options.detection.method = DetectionMethod::gradient;
    options.detection.gradient.min_box_area = 10'000;
    options.detection.gradient.fall_back = false;
    HinderedRun run(options);
    const Explanation told = run.explanation();
    EXPECT_FALSE(told.found);
    EXPECT_EQ(told.parameter, "gradient.min_box_area") << told.sentence;
    EXPECT_EQ(firstStageOf(told.parameter), ChainStage::detection);
    EXPECT_FALSE(told.rejection || told.drop);

    Replay replay(run.replaySource());
    const ReplayedFrame* stages = replay.at(HinderedRun::kFrame, {});
    ASSERT_NE(stages, nullptr);
    const auto clusters = clustersAtPlace(run.place(), stages->result.motion, stages->result.clusters);
    ASSERT_FALSE(clusters.empty());
    EXPECT_EQ(countRejections(stages->result.detections, clusters.front()).delivered(), 0);
    const auto searches = replay.trace(clusters.front());
    ASSERT_EQ(searches.size(), 1U);
    EXPECT_TRUE(searches.front().detections.empty());
    EXPECT_TRUE(std::any_of(searches.front().trace.checks.begin(), searches.front().trace.checks.end(),
                            [&](const auto& check) { return !check.passed && check.parameter == told.parameter; }));

    EXPECT_EQ(run.diagnosis().cause, ErrorCause::not_detected);
}

/// Parameters that make removal reject all detections, and what everyone has to name.
struct Refusal {
    Rejection rejection;
    std::string parameter;
    ChainOptions options;
};

TEST(SameRejection, WhatRemovalRejects) {
    const auto with = [](const Rejection rejection, const std::string& parameter, ChainOptions options,
                         const auto& hinder) {
        hinder(options.outliers);
        return Refusal{rejection, parameter, options};
    };
    const std::vector<Refusal> refusals{
        with(Rejection::outlier, "outliers.min_vectors", {}, [](auto& o) { o.min_vectors = 500; }),
        with(Rejection::size, "outliers.min_area", sizesAlone(), [](auto& o) { o.min_area = 10'000; }),
        with(Rejection::size, "outliers.min_length", sizesAlone(), [](auto& o) { o.min_length_m = 50; }),
        with(Rejection::size, "outliers.max_length", sizesAlone(), [](auto& o) { o.max_length_m = 0.2; }),
        with(Rejection::size, "outliers.max_width", sizesAlone(), [](auto& o) { o.max_width_m = 0.2; }),
    };
    for (const Refusal& refusal : refusals) {
        HinderedRun run(refusal.options);
        const Explanation told = run.explanation();
        EXPECT_FALSE(told.found);
        EXPECT_EQ(told.parameter, refusal.parameter) << told.sentence;
        ASSERT_EQ(told.rejection, refusal.rejection) << told.sentence;
        EXPECT_FALSE(told.drop);

        Replay replay(run.replaySource());
        const ReplayedFrame* stages = replay.at(HinderedRun::kFrame, {});
        ASSERT_NE(stages, nullptr);
        const auto& detections = stages->result.detections;
        const auto here = std::find_if(detections.begin(), detections.end(),
                                       [&](const Detection& found) { return atPlace(found.box, run.place()); });
        ASSERT_NE(here, detections.end()) << refusal.parameter;
        const RejectionCounts counts = countRejections(detections, here->cluster);
        EXPECT_GT(counts[refusal.rejection], 0) << refusal.parameter;
        EXPECT_EQ(counts.kept(), 0) << refusal.parameter;

        const DiagnosedError miss = run.diagnosis();
        EXPECT_EQ(miss.cause, causeOf(refusal.rejection)) << miss.text;
        EXPECT_THAT(miss.text, HasSubstr(named(refusal.parameter)));
    }
}

/// Stages end before tracks; Why? and the list of errors go on.
TEST(SameRejection, WhatTrackingAndFinishingLeaveOut) {
    struct LeftOut {
        TrackDrop why;
        std::string parameter;
        void (*hinder)(ChainOptions& options);
    };
    const std::vector<LeftOut> all{
        {TrackDrop::unconfirmed, "tracking.confirm_hits",
         [](ChainOptions& o) { o.tracking.confirm_hits = o.tracking.confirm_window = 64; }},
        {TrackDrop::too_small, "finishing.min_length", [](ChainOptions& o) { o.finishing.min_length_m = 50; }},
        {TrackDrop::wider_than_long, "finishing.max_aspect", [](ChainOptions& o) { o.finishing.max_aspect = 0.1; }},
        {TrackDrop::unlikely, "finishing.min_score", [](ChainOptions& o) { o.finishing.min_score = 1; }},
    };
    for (const LeftOut& left_out : all) {
        ChainOptions options = nothingDropped();
        left_out.hinder(options);
        HinderedRun run(options);
        run.finish();
        const Explanation told = run.explanation();
        EXPECT_FALSE(told.found) << told.sentence;
        EXPECT_EQ(told.parameter, left_out.parameter) << told.sentence;
        ASSERT_EQ(told.drop, left_out.why) << told.sentence;
        EXPECT_FALSE(told.rejection);
        const DiagnosedError miss = run.diagnosis();
        EXPECT_EQ(miss.cause, causeOf(left_out.why)) << miss.text;
        EXPECT_THAT(miss.text, HasSubstr(named(left_out.parameter)));
    }
}

/// A frame with a cluster and a detection at one place, whose fate is put in by hand: what a scene does not show.
class HandMadeFrame : public testing::Test {
 protected:
    HandMadeFrame() {
        options.clustering.min_density_share = 0;
        options.outliers.min_density_share = 0;
        evidence.area = placeAt({100, 100}, scale);
        evidence.corners = CornerVerdicts{};
        evidence.tracking = TrackingTrace{};
        FrameMotion& motion = evidence.result.motion;
        motion.frame = 30;
        motion.image_size = {1000, 500};
        motion.corner_count = 1000;
        motion.registration.state = RegistrationState::registered;
        motion.motion_vectors = {{1, {94, 98}, {2, 0}, 20},
                                 {2, {100, 98}, {2, 0}, 20},
                                 {3, {106, 98}, {2, 0}, 20},
                                 {4, {100, 102}, {2, 0}, 20}};
        MotionCluster cluster;
        cluster.box = {{100, 100}, 13, 5, 0};
        cluster.velocity = {2, 0};
        cluster.members = {0, 1, 2, 3};
        evidence.result.clusters = {cluster};
        evidence.result.rois = {{{100, 100}, 30, 14, 0}};
        add({{100, 100}, 18, 7, 0}, Rejection::none);
    }
    /// With the vectors an outlier has, or those that others have.
    void add(const OrientedBox& box, Rejection rejection) {
        Detection detection;
        detection.box = box;
        detection.velocity = {2, 0};
        detection.cluster = 0;
        detection.vectors = {0, 1, 2, 3};
        if (rejection == Rejection::outlier) detection.vectors = {0, 1};
        detection.rejection = rejection;
        evidence.result.detections.push_back(detection);
    }
    Explanation why() const { return explain(evidence, options, scale); }
    DiagnosedError miss() const {
        DiagnosisSource source;
        source.options = options;
        source.scale = scale;
        source.frame_result = [this](FrameIndex) { return std::optional(evidence.result); };
        return test::missOf(std::move(source), 30, evidence.area);
    }

    const SceneScale scale{0.25, 25, true};
    ChainOptions options;
    PlaceEvidence evidence;
};

TEST_F(HandMadeFrame, EveryRejectionHasOneCause) {
    options.outliers.max_width_m = 1;  // 4 px, and the box has 7; only asked where it is the reason
    for (const Rejection rejection : {Rejection::duplicate, Rejection::outlier, Rejection::size}) {
        evidence.result.detections.clear();
        add({{100, 100}, 18, 7, 0}, rejection);
        const Explanation told = why();
        const DiagnosedError error = miss();
        EXPECT_EQ(told.rejection, rejection) << told.sentence;
        EXPECT_EQ(error.cause, causeOf(rejection)) << error.text;
        EXPECT_EQ(countRejections(evidence.result.detections, 0)[rejection], 1);
        // Which of the rules for duplicates it was, a run does not store.
        if (rejection != Rejection::duplicate) {
            EXPECT_THAT(error.text, HasSubstr(named(told.parameter)));
            EXPECT_THAT(told.sentence, HasSubstr(test::comparisonIn(error))) << "one wording for both";
        }
    }
}

TEST_F(HandMadeFrame, EveryTrackDropHasOneCause) {
    for (const TrackDrop drop :
         {TrackDrop::unconfirmed, TrackDrop::too_small, TrackDrop::wider_than_long, TrackDrop::shares_place,
          TrackDrop::shadow, TrackDrop::hardly_detected, TrackDrop::could_stand, TrackDrop::unlikely}) {
        evidence.result.dropped = {{7, evidence.result.detections.front().box, drop, 2}};
        const Explanation told = why();
        const DiagnosedError error = miss();
        EXPECT_EQ(told.drop, drop) << told.sentence;
        EXPECT_EQ(told.parameter, parameterOf(drop));
        EXPECT_EQ(error.cause, causeOf(drop)) << error.text;
        EXPECT_THAT(error.text, HasSubstr(named(told.parameter)));
    }
}

TEST_F(HandMadeFrame, ATrackThatIsStillTentativeIsOneForBoth) {
    TrackState state;
    state.id = 7;
    state.box = evidence.result.detections.front().box;
    state.status = TrackStatus::tentative;
    evidence.result.tracks = {state};
    EXPECT_EQ(why().drop, TrackDrop::unconfirmed);
    EXPECT_EQ(miss().cause, ErrorCause::tentative);
    EXPECT_THAT(miss().text, HasSubstr(named(why().parameter)));
}

TEST_F(HandMadeFrame, TheLastStageThatHadTheObjectDecides) {
    evidence.result.detections.clear();
    add({{100, 100}, 18, 7, 0}, Rejection::outlier);
    evidence.result.dropped = {{7, {{100, 100}, 18, 7, 0}, TrackDrop::shadow, 2}};
    const Explanation told = why();
    EXPECT_EQ(told.drop, TrackDrop::shadow) << told.sentence;
    EXPECT_FALSE(told.rejection);
    EXPECT_EQ(miss().cause, ErrorCause::track_dropped);
}

TEST_F(HandMadeFrame, OfTwoRejectedDetectionsThatWhichLiesBetterOnThePlaceDecides) {
    evidence.result.detections.clear();
    add({{100, 100}, 18, 7, 0}, Rejection::duplicate);
    add({{106, 100}, 18, 7, 0}, Rejection::outlier);
    EXPECT_EQ(why().rejection, Rejection::duplicate) << why().sentence;
    EXPECT_EQ(miss().cause, ErrorCause::removed_duplicate);
    evidence.result.detections[0].box.centre.x = 106;
    evidence.result.detections[1].box.centre.x = 100;
    EXPECT_EQ(why().rejection, Rejection::outlier) << why().sentence;
    EXPECT_EQ(miss().cause, ErrorCause::removed_outlier);
}

TEST_F(HandMadeFrame, AFrameThatWasNotRegistered) {
    evidence.result.motion.registration.state = RegistrationState::failed;
    evidence.result.motion.registration.failure = {.fault = RegistrationFault::too_few_agree, .count = 12, .of = 40};
    evidence.result.motion.motion_vectors.clear();
    evidence.result.clusters.clear();
    evidence.result.detections.clear();
    EXPECT_EQ(why().parameter, "registration.min_inliers");
    EXPECT_EQ(miss().cause, ErrorCause::unregistered);
    EXPECT_THAT(miss().text, HasSubstr(named("registration.min_inliers")));
}

}  // namespace
}  // namespace eyrie::same_rejection_test
