#include <gtest/gtest.h>

#include "rerun/replay.h"
#include "rerun/run_by_hand.h"

/// What a replay answers after it went back, was stopped or met frozen pictures.
namespace eyrie::replay_by_hand_test {
namespace {

test::RunByHand runOfDifferences() {
    test::RunByHand run;
    run.options.difference.method = MotionMethod::two_frame_difference;
    run.options.difference.gap = 1;
    return run;
}

std::vector<cv::Point2d> centresOf(const std::vector<MotionCluster>& clusters) {
    std::vector<cv::Point2d> centres;
    for (const MotionCluster& cluster : clusters) centres.push_back(cluster.box.centre);
    return centres;
}

std::stop_token stopped() {
    std::stop_source stop;
    stop.request_stop();
    return stop.get_token();
}

TEST(ReplayByHand, GoesOnInAnyOrderAndFindsTheSame) {
    test::RunByHand run = runOfDifferences();
    const std::vector<FrameResult> whole = run.runWith(run.options);
    Replay replay(run.source());
    for (const FrameIndex frame : {30, 31, 39, 12, 12, 25, 5, 0}) {
        const ReplayedFrame* replayed = replay.at(frame, {});
        ASSERT_NE(replayed, nullptr) << frame;
        EXPECT_EQ(replayed->frame.index, frame);
        EXPECT_EQ(replayed->result.motion.frame, frame);
        EXPECT_EQ(centresOf(replayed->result.clusters), centresOf(whole[static_cast<std::size_t>(frame)].clusters));
        EXPECT_TRUE(replayed->exact);
    }
    EXPECT_FALSE(whole[39].clusters.empty());
}

TEST(ReplayByHand, StartsAsFarBackAsItReachesAndNoFarther) {
    test::RunByHand run = runOfDifferences();
    Replay replay(run.source());
    ASSERT_EQ(replay.reach(), 9);
    ASSERT_NE(replay.at(30, {}), nullptr);
    EXPECT_EQ(run.pictures_read.front(), 21);
    EXPECT_EQ(run.pictures_read.size(), 10U);
    run.pictures_read.clear();
    ASSERT_NE(replay.at(38, {}), nullptr);
    EXPECT_EQ(run.pictures_read.front(), 31) << "farther back than it starts anew, so it went on";
    run.pictures_read.clear();
    ASSERT_NE(replay.at(38, {}), nullptr);
    EXPECT_TRUE(run.pictures_read.empty()) << "it stands there";
    ASSERT_NE(replay.at(4, {}), nullptr);
    EXPECT_EQ(run.pictures_read.front(), 0);
    run.pictures_read.clear();
    ASSERT_NE(replay.at(15, {}), nullptr);
    EXPECT_EQ(run.pictures_read.front(), 6) << "from there it is as near as from 5";
}

TEST(ReplayByHand, DoesNotAnswerWithAnotherFrameAfterItWasStopped) {
    test::RunByHand run;
    Replay replay(run.source());
    ASSERT_NE(replay.at(30, {}), nullptr);
    EXPECT_EQ(replay.at(10, stopped()), nullptr);
    EXPECT_TRUE(replay.trace(0).empty()) << "nothing was answered since it went back";
    const ReplayedFrame* replayed = replay.at(9, {});
    ASSERT_NE(replayed, nullptr);
    EXPECT_EQ(replayed->frame.index, 9);
    EXPECT_EQ(replayed->result.motion.frame, 9);
    EXPECT_FALSE(replay.clustering().groups.empty());
}

TEST(ReplayByHand, DoesNotAnswerWithFramesThatItOnlyRemembered) {
    test::RunByHand run = runOfDifferences();
    const std::vector<FrameResult> whole = run.runWith(run.options);
    ReplaySource source = run.source();
    std::stop_source stop;
    source.pixels = [&, pixels = source.pixels](FrameIndex frame) {
        if (frame == 13) stop.request_stop();
        return pixels(frame);
    };
    Replay replay(std::move(source));
    ASSERT_NE(replay.at(10, {}), nullptr);
    ASSERT_FALSE(replay.trace(0).empty());
    EXPECT_EQ(replay.at(18, stop.get_token()), nullptr);
    EXPECT_TRUE(replay.trace(0).empty());
    const ReplayedFrame* replayed = replay.at(13, {});
    ASSERT_NE(replayed, nullptr);
    EXPECT_EQ(replayed->result.motion.frame, 13);
    EXPECT_EQ(centresOf(replayed->result.clusters), centresOf(whole[13].clusters));
}

TEST(ReplayByHand, FrozenPicturesRepeatTheAnswerBeforeThem) {
    test::RunByHand run = runOfDifferences();
    run.frozen = {17, 18};
    const std::vector<FrameResult> whole = run.runWith(run.options);
    ASSERT_FALSE(whole[18].clusters.empty());
    ASSERT_EQ(centresOf(whole[18].clusters), centresOf(whole[16].clusters));
    Replay replay(run.source());
    const ReplayedFrame* replayed = replay.at(18, {});
    ASSERT_NE(replayed, nullptr);
    EXPECT_EQ(centresOf(replayed->result.clusters), centresOf(whole[18].clusters));
}

TEST(ReplayByHand, HasNothingBeforeTheRunsFirstFrameNorWhereAFrameIsMissing) {
    test::RunByHand run = runOfDifferences();
    run.missing = {22};
    ReplaySource source = run.source();
    source.first_frame = 5;
    Replay replay(std::move(source));
    EXPECT_EQ(replay.at(4, {}), nullptr);
    ASSERT_NE(replay.at(7, {}), nullptr);
    EXPECT_EQ(run.pictures_read.front(), 5);
    ASSERT_NE(replay.at(21, {}), nullptr);
    EXPECT_EQ(replay.at(22, {}), nullptr);
    const ReplayedFrame* replayed = replay.at(21, {});
    ASSERT_NE(replayed, nullptr) << "what was there before is there";
    EXPECT_EQ(replayed->frame.index, 21);
}

TEST(ReplayByHand, SaysWhetherStacksBeganWithTheRun) {
    test::RunByHand run;
    run.options.stacking.enabled = true;
    run.options.stacking.capacity = 6;
    Replay replay(run.source());
    ASSERT_EQ(replay.reach(), 12);
    ASSERT_NE(replay.at(12, {}), nullptr);
    EXPECT_TRUE(replay.at(12, {})->exact);
    ASSERT_NE(replay.at(34, {}), nullptr);
    EXPECT_FALSE(replay.at(34, {})->exact);
    EXPECT_FALSE(replay.at(34, {})->differences);
    Replay late(run.source());
    ASSERT_NE(late.at(13, {}), nullptr);
    EXPECT_FALSE(late.at(13, {})->exact) << "frame 0 could play a part";
}

}  // namespace
}  // namespace eyrie::replay_by_hand_test
