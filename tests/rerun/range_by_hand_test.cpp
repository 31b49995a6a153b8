#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rerun/method_run.h"
#include "rerun/motion_window.h"
#include "rerun/range_run.h"
#include "rerun/run_by_hand.h"
#include "support/moving_scene.h"

/// Which frames parts of a video do, and what they tell on the way.
namespace eyrie::range_by_hand_test {
namespace {

using testing::ElementsAre;

/// What a range tells of the frames that lead up to it and of its own.
struct Told {
    int leading = 0;
    std::vector<FrameIndex> own{};
    int total = 0;
    bool exact = false;
    std::size_t frames = 0;
};

Told toldOf(test::RunByHand& run, const ChainOptions& options, FrameRange range, FrameIndex first_frame = 0) {
    ReplaySource source = run.source();
    source.first_frame = first_frame;
    Told told;
    int last_done = 0;
    const auto result =
        runRange(source, options, range, {}, [&](const std::shared_ptr<const FrameResult>& found, int done, int total) {
            EXPECT_EQ(done, ++last_done);
            told.total = total;
            if (found)
                told.own.push_back(found->motion.frame);
            else
                ++told.leading;
        });
    told.exact = result->exact;
    told.frames = result->frames.size();
    return told;
}

TEST(RangeByHand, FortyFramesLeadUpToItOrWhatDifferencesReachBack) {
    test::RunByHand run;
    run.frames = 70;
    run.vehicles = {{{20, 30}, 1}};
    ChainOptions options = run.options;
    options.tracking.confirm_hits = 4;
    const Told late = toldOf(run, options, {41, 43});
    EXPECT_EQ(late.leading, 40);
    EXPECT_THAT(late.own, ElementsAre(41, 42, 43));
    EXPECT_EQ(late.total, 43);
    EXPECT_EQ(late.frames, 3U);
    EXPECT_FALSE(late.exact) << "frame 0 could play a part";
    EXPECT_TRUE(toldOf(run, options, {40, 43}).exact);
    const Told early = toldOf(run, options, {2, 6}, 5);
    EXPECT_EQ(early.leading, 0);
    EXPECT_THAT(early.own, ElementsAre(5, 6)) << "the run begins there";
    EXPECT_EQ(early.total, 2);
    EXPECT_TRUE(early.exact);
    EXPECT_EQ(toldOf(run, options, {20, 20}, 5).leading, 15);
    options.difference.method = MotionMethod::median_background;
    options.difference.background_frames = 6;
    options.difference.background_step = 7;
    EXPECT_EQ(toldOf(run, options, {60, 60}).leading, 42 + 8);
}

TEST(RangeByHand, EndsWhereTheRunEnds) {
    test::RunByHand run;
    run.frames = 12;
    ChainOptions options = run.options;
    options.tracking.confirm_hits = 4;
    const Told told = toldOf(run, options, {10, 30});
    EXPECT_EQ(told.leading, 10);
    EXPECT_THAT(told.own, ElementsAre(10, 11));
    EXPECT_EQ(told.total, 31);
}

TEST(RangeByHand, OnlyKeptDetectionsBecomeBoxes) {
    test::RunByHand run;
    run.vehicles = {{{20, 30}}, {{20, 60}}};
    ChainOptions options = run.options;
    options.clustering.min_members = 4;
    const auto all = runRange(run.source(), options, {10, 12}, {});
    EXPECT_EQ(detectionBoxesOf(*all).size(), 3U);
    EXPECT_EQ(detectionBoxesOf(*all)[11].size(), 2U);
    ASSERT_EQ(trackBoxesOf(*all)[11].size(), 2U);
    EXPECT_EQ(trackBoxesOf(*all)[11][0].frame, 11);
    options.outliers.min_vectors = 9;
    const auto none = runRange(run.source(), options, {10, 12}, {});
    EXPECT_EQ(none->frames.at(11)->detections.size(), 2U) << "seen, but rejected";
    EXPECT_TRUE(detectionBoxesOf(*none).empty());
    EXPECT_TRUE(trackBoxesOf(*none).empty());
}

/// Pictures on which nothing is to be found.
test::MemorySource blank(int frames) {
    return {frames, {64, 48}, [](int) { return cv::Mat(48, 64, CV_8UC1, cv::Scalar(90)); }};
}

TEST(MethodsByHand, DoTheFramesAskedForOnceEach) {
    const std::vector<MethodVariant> methods{methodVariant("clusters", {}),
                                             methodVariant("three_frame_difference_sort", {})};
    const auto framesOf = [&](FrameRange range) {
        test::MemorySource source = blank(9);
        std::vector<std::vector<FrameIndex>> seen(2);
        runMethods(source, range, methods, {0.25, 25, true}, {}, {},
                   [&](std::size_t method, const std::shared_ptr<const FrameResult>& result, const Frame& frame) {
                       EXPECT_EQ(result->motion.frame, frame.index);
                       seen[method].push_back(frame.index);
                   });
        EXPECT_EQ(seen[0], seen[1]);
        return seen[0];
    };
    EXPECT_EQ(framesOf({}).size(), 9U);
    EXPECT_THAT(framesOf({6, -1}), ElementsAre(6, 7, 8)) << "to the end";
    EXPECT_THAT(framesOf({0, 2}), ElementsAre(0, 1, 2));
    EXPECT_THAT(framesOf({8, 8}), ElementsAre(8));
    for (const FrameRange outside : {FrameRange{-1, 5}, FrameRange{0, 9}, FrameRange{9, -1}, FrameRange{5, 4}})
        EXPECT_THROW(framesOf(outside), Error) << outside.first << " to " << outside.last;
}

TEST(MethodsByHand, TellHowFarTheyAreAndStopWhenAsked) {
    test::MemorySource source = blank(9);
    std::stop_source stop;
    std::vector<int> done;
    const auto results =
        runMethods(source, {2, 7}, {methodVariant("clusters", {})}, {0.25, 25, true}, stop.get_token(),
                   [&](const RunProgress& progress) {
                       done.push_back(progress.frames_done);
                       EXPECT_EQ(progress.frames_total, 6);
                       EXPECT_GT(progress.frames_per_second, 0);
                       EXPECT_NEAR(progress.seconds_left * progress.frames_per_second, 6 - progress.frames_done, 1e-6);
                       if (progress.frames_done == 4) stop.request_stop();
                   });
    EXPECT_THAT(done, ElementsAre(1, 2, 3, 4));
    ASSERT_EQ(results.size(), 1U);
    const auto nothing = runMethods(source, {}, {methodVariant("clusters", {})}, {0.25, 25, true}, stop.get_token());
    ASSERT_EQ(nothing.size(), 1U);
    EXPECT_EQ(nothing[0].name, "clusters");
    EXPECT_EQ(nothing[0].median_ms, StageTimes{});
}

TEST(MethodsByHand, AnUnknownWordIsAnsweredWithAllThatAreKnown) {
    try {
        methodVariant("magic", {});
        FAIL() << "there is no magic";
    } catch (const Error& error) {
        std::string all;
        for (const std::string& word : methodWords()) all += (all.empty() ? "" : ", ") + word;
        EXPECT_THAT(error.what(), testing::HasSubstr("\"magic\""));
        EXPECT_THAT(error.what(), testing::HasSubstr("the methods " + all));
    }
}

TEST(MotionWindowVerdicts, AreThoseOnTheLastFrame) {
    test::MovingScene scene;
    scene.size = {160, 120};
    scene.frames = 22;
    scene.vehicles = {{{60, 60}, {2.0, 0}, {24, 11}}};
    test::MemorySource source(scene);
    const SceneScale scale{0.2, 25, true};
    MotionWindow window(RegistrationOptions{}, scale);
    ASSERT_TRUE(window.cover(0, 21, [&](FrameIndex frame) { return source.read(frame, false); }, {}));
    IndependentMotionOptions options;
    options.silhouettes.silhouettes = false;
    options.areas.areas = false;
    CornerVerdicts verdicts;
    const FrameMotion last = window.motions(options, 2, &verdicts).back();
    std::map<CornerId, cv::Point2f> moving;
    for (const CornerVerdict& verdict : verdicts) {
        if (verdict.fate == CornerFate::moving) moving[verdict.id] = verdict.position;
    }
    int corners = 0;
    for (const MotionVector& vector : last.motion_vectors) {
        if (vector.isInferred()) continue;
        ++corners;
        EXPECT_EQ(moving[vector.id], vector.position);
    }
    EXPECT_GT(corners, 3);
    EXPECT_EQ(moving.size(), static_cast<std::size_t>(corners));
}

}  // namespace
}  // namespace eyrie::range_by_hand_test
