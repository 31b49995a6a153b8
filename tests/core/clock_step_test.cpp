#include "core/time/clock_step.h"

#include <gtest/gtest.h>

namespace eyrie::clock_step_test {

TEST(ClockStep, TellsMissingPicturesInWholeFrames) {
    EXPECT_EQ(framesByClock(40'000, 25), 1);
    EXPECT_EQ(framesByClock(80'000, 25), 2);
    EXPECT_EQ(framesByClock(1'000'000, 25), 25);
    EXPECT_EQ(framesByClock(3'000'000, 2), 6);
}

TEST(ClockStep, TremblesByAFewMillisecondsAsContainersDo) {
    EXPECT_EQ(framesByClock(67'000, 30), 2);
    EXPECT_EQ(framesByClock(66'000, 30), 2);
    EXPECT_EQ(framesByClock(37'000, 30), 1);
}

TEST(ClockStep, TellsNothingBetweenWholeFramesOrOverAJump) {
    EXPECT_EQ(framesByClock(60'000, 25), 1) << "a rate that changes";
    EXPECT_EQ(framesByClock(3'600'000'000, 25), 1) << "the recording paused";
    EXPECT_EQ(framesByClock(0, 25), 1);
    EXPECT_EQ(framesByClock(-80'000, 25), 1);
}

}  // namespace eyrie::clock_step_test
