#include "chain/live/chain_pace.h"

#include <gtest/gtest.h>

/// When the chain of a live source is made lighter, and when it is the whole one again.
namespace eyrie::chain_pace_test {
namespace {

/// Frames that are still worked on by the lighter chain once no frame waits any more.
int framesUntilWhole(ChainPace& pace, double backlog = 0) {
    int frames = 0;
    while (frames < 10000 && pace.isLighter(backlog)) ++frames;
    return frames;
}

}  // namespace

TEST(ChainPace, IsLighterWhereMoreThanHalfOfTheFramesThatMayWaitDoSo) {
    ChainPace pace(25);
    for (const double backlog : {0.0, 0.3, 0.5}) EXPECT_FALSE(pace.isLighter(backlog)) << backlog;
    EXPECT_TRUE(pace.isLighter(0.51));
    EXPECT_TRUE(pace.isLighter(0.3)) << "still";
    EXPECT_TRUE(ChainPace(25).isLighter(1));
}

TEST(ChainPace, IsWholeAgainAfterTwoSecondsInPaceAndLaterAfterFour) {
    for (const double frame_rate_hz : {10.0, 25.0}) {
        ChainPace pace(frame_rate_hz);
        int patience = static_cast<int>(2 * frame_rate_hz);
        for (int time = 0; time < 4; ++time) {
            EXPECT_TRUE(pace.isLighter(0.8));
            EXPECT_EQ(framesUntilWhole(pace) + 1, patience) << time;
            for (int i = 0; i < 20; ++i) EXPECT_FALSE(pace.isLighter(0.4)) << "not behind enough";
            patience *= 2;
        }
    }
}

TEST(ChainPace, ATenthOfTheFramesMayWaitInPace) {
    ChainPace pace(10);
    EXPECT_TRUE(pace.isLighter(0.8));
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(pace.isLighter(0.11));
    for (int i = 0; i < 19; ++i) EXPECT_TRUE(pace.isLighter(0.1)) << i;
    EXPECT_TRUE(pace.isLighter(0.2)) << "and it begins anew";
    EXPECT_EQ(framesUntilWhole(pace, 0.1) + 1, 20);
}

}  // namespace eyrie::chain_pace_test
