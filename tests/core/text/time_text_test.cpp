#include "core/time/time_text.h"

#include <gtest/gtest.h>

namespace eyrie::time_text_test {

TEST(TimeText, IsRoundedToItsDecimals) {
    EXPECT_EQ(timeText(0), "0:00.00");
    EXPECT_EQ(timeText(62'480'000, 3), "1:02.480");
    EXPECT_EQ(timeText(3'602'000'000, 0), "1:00:02");
    EXPECT_EQ(timeText(59'996'000, 2), "1:00.00") << "rounding carries";
    EXPECT_EQ(timeText(-500'000, 1), "-0:00.5");
    EXPECT_EQ(timeText(50'000, 1), "0:00.1") << "a half rounds up";
    EXPECT_EQ(timeText(49'999, 1), "0:00.0");
    EXPECT_EQ(timeText(-50'000, 1), "-0:00.1");
    EXPECT_EQ(timeText(62'008'000, 3), "1:02.008") << "zeros in front are decimals";
    EXPECT_EQ(timeText(62'008'000, 9), "1:02.008") << "there are three at most";
    EXPECT_EQ(timeText(62'008'000, -1), "1:02");
    EXPECT_EQ(timeText(3'599'000'000, 0), "59:59");
    EXPECT_EQ(timeText(3'600'000'000, 0), "1:00:00");
    EXPECT_EQ(timeText(36'671'000'000, 0), "10:11:11");
    EXPECT_EQ(timeText(-4'000, 1), "0:00.0") << "nothing is before or behind zero";
}

TEST(TimeText, TheClockOfAnEventIsThatOfTheTimelineInTenths) {
    EXPECT_EQ(videoClockText(0), "0:00.0");
    EXPECT_EQ(videoClockText(12.96), "0:13.0") << "as the window shows frame 324 of 25 a second";
    EXPECT_EQ(videoClockText(62.449), "1:02.4");
    EXPECT_EQ(videoClockText(3723.4), "1:02:03.4");
    for (const double seconds : {0.05, 1.25, 59.96, 7200.349}) {
        const auto time_us = static_cast<std::int64_t>(seconds * 1e6 + 0.5);
        EXPECT_EQ(videoClockText(seconds), timeText(time_us, 1)) << seconds;
    }
}

}  // namespace eyrie::time_text_test
