// What is told of the light in the stretches of a run.
#include "tracking/pictures/light_telling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tracking/frame_summaries.h"

namespace eyrie::light_telling_test {
namespace {

const SceneScale kScale{0.2, 25, true};  // 5 px are 1 m

/// A camera that turns by `turn` a frame and was not registered in some frames.
GroundTurns turning(double turn, std::vector<FrameIndex> cuts = {}) {
    GroundMotion ground;
    for (FrameIndex frame = 0; frame < 40; ++frame) {
        FrameMotionSummary summary = test::summaryOfFrame(frame);
        const double c = std::cos(turn);
        const double s = std::sin(turn);
        if (frame > 0)
            summary.registration.current_from_previous.matrix = {
                c, -s, 320 - 320 * c + 180 * s, s, c, 180 - 320 * s - 180 * c, 0, 0, 1};
        if (std::count(cuts.begin(), cuts.end(), frame) > 0) summary.registration.state = RegistrationState::failed;
        ground.add(summary);
    }
    return GroundTurns(ground, 0, 39);
}

TrackPath pathOf(TrackId id, FrameIndex first, FrameIndex last) {
    TrackPath path{id, {}};
    for (FrameIndex frame = first; frame <= last; ++frame) path.states.emplace_back(frame, PathState());
    return path;
}

StretchLight readingOf(FrameIndex stretch, LightOutcome outcome, int tracks, cv::Point2d reach = {}) {
    StretchLight read;
    read.shadow = {stretch, reach, tracks, 0.9};
    read.outcome = outcome;
    read.scatter_m = 0.1;
    read.darkening = 0.4;
    return read;
}

}  // namespace

TEST(LightTelling, ShadowsAreToldInTheirFirstPictureAndInEachThatFollows) {
    const GroundTurns turns = turning(0.02);
    const RunLight light =
        toldShadows({readingOf(0, LightOutcome::shadows, 6, {0, 2})}, turns, kScale, {pathOf(1, 0, 39)}, {}, {});
    ASSERT_EQ(light.findings.size(), 1U);
    const LightFinding& finding = light.findings[0];
    EXPECT_EQ(finding.first_frame, 0);
    EXPECT_EQ(finding.last_frame, 39);
    EXPECT_NEAR(finding.heading, CV_PI / 2, 1e-12);
    EXPECT_NEAR(finding.reach_m, 2, 1e-12);
    EXPECT_EQ(finding.vehicles, 6);
    EXPECT_EQ(finding.agreement, 0.9);
    EXPECT_EQ(finding.scatter_m, 0.1);
    EXPECT_EQ(finding.darkening, 0.4);
    ASSERT_EQ(light.frames.size(), 40U);
    for (const FrameShadow& shadow : light.frames) {
        EXPECT_NEAR(shadow.heading, CV_PI / 2 + 0.02 * shadow.frame, 1e-6);
        EXPECT_NEAR(shadow.reach_px, 10, 1e-6);
    }
    // As boxes are trimmed by it.
    const cv::Point2d trimmed_by = reachAt({0, {0, 2}, 6, 0.9}, turns.at(30), {100, 50}, kScale);
    EXPECT_LT(cv::norm(trimmed_by - shadowReach(light.frames[30], {100, 50}, kScale)), 1e-6);
}

TEST(LightTelling, EachStretchIsToldButThoseWithoutShadowsTogether) {
    const GroundTurns turns = turning(0, {10, 11, 12, 30});
    const RunLight light =
        toldShadows({readingOf(0, LightOutcome::disagreement, 7, {1, 0}), readingOf(11, LightOutcome::few_vehicles, 2),
                     readingOf(12, LightOutcome::shadows, 5, {1, 0})},
                    turns, kScale, {pathOf(1, 0, 39)}, {}, {});
    std::vector<std::pair<FrameIndex, LightOutcome>> told;
    for (const LightFinding& finding : light.findings) told.emplace_back(finding.first_frame, finding.outcome);
    // A frame that was not registered begins a stretch.
    const std::vector<std::pair<FrameIndex, LightOutcome>> expected{{0, LightOutcome::disagreement},
                                                                    {10, LightOutcome::few_vehicles},
                                                                    {12, LightOutcome::shadows},
                                                                    {30, LightOutcome::few_vehicles}};
    ASSERT_EQ(told, expected);
    EXPECT_EQ(light.findings[1].vehicles, 2) << "the most of what is told as one";
    EXPECT_EQ(light.findings[1].last_frame, 11);
    EXPECT_EQ(light.frames.size(), 18U);
    EXPECT_EQ(light.findings[0].heading, 0) << "which is of use with shadows alone";
}

TEST(LightTelling, TracksCountInEachStretchInWhichTheyLive) {
    const GroundTurns turns = turning(0, {20});
    const RunLight light = toldShadows(
        {readingOf(0, LightOutcome::shadows, 5, {1, 0}), readingOf(20, LightOutcome::shadows, 5, {0, 1})}, turns,
        kScale, {pathOf(1, 0, 39), pathOf(2, 0, 10), pathOf(3, 25, 30)},
        {{1, {LightOutcome::shadows, 0.5, 0, 0.1}}, {2, {LightOutcome::shadows, 0.5, 0, 0.1}}}, {pathOf(4, 18, 24)});
    ASSERT_EQ(light.findings.size(), 2U);
    EXPECT_EQ(light.findings[0].trimmed, 2);
    EXPECT_EQ(light.findings[1].trimmed, 1);
    EXPECT_EQ(light.findings[0].dropped, 0);
    EXPECT_EQ(light.findings[1].dropped, 1) << "by the middle of its life";
    EXPECT_EQ(light.trims.size(), 2U);
}

TEST(LightTelling, WhyNobodyLookedHoldsForAllFramesOfTheTracks) {
    EXPECT_TRUE(untoldLight({}, LightOutcome::no_scale).findings.empty());
    const RunLight light = untoldLight({pathOf(1, 5, 9), pathOf(2, 2, 7)}, LightOutcome::no_scale);
    ASSERT_EQ(light.findings.size(), 1U);
    EXPECT_EQ(light.findings[0].outcome, LightOutcome::no_scale);
    EXPECT_EQ(light.findings[0].first_frame, 2);
    EXPECT_EQ(light.findings[0].last_frame, 9);
    EXPECT_TRUE(light.frames.empty());
}

TEST(LightTelling, BeamsAreOfAllFrames) {
    const RunLight light = toldBeams({4, {{7, {LightOutcome::beams, 0.3, 0, 0.3}}}}, turning(0, {20}));
    ASSERT_EQ(light.findings.size(), 1U);
    EXPECT_EQ(light.findings[0].outcome, LightOutcome::beams);
    EXPECT_EQ(light.findings[0].last_frame, 39);
    EXPECT_EQ(light.findings[0].vehicles, 4);
    EXPECT_EQ(light.findings[0].trimmed, 1);
    EXPECT_EQ(light.trims.at(7).taken, 0.3);
}

}  // namespace eyrie::light_telling_test
