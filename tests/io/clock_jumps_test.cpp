#include "io/clock_jumps.h"

#include <gtest/gtest.h>

#include <vector>

namespace eyrie::clock_jumps_test {
namespace {

std::string textOf(const std::vector<std::int64_t>& times_ms, double rate_hz = 25) {
    ClockJumps jumps(rate_hz);
    for (std::size_t i = 0; i < times_ms.size(); ++i) jumps.see(static_cast<FrameIndex>(i), times_ms[i] * 1000);
    return jumps.text();
}

}  // namespace

TEST(ClockJumps, AreToldWithTheirPlaceAndWhatToDo) {
    EXPECT_EQ(
        textOf({0, 40, 80, 3'600'120, 3'600'160}),
        "the clock of the video leaps ahead by 1:00:00 before frame 3, and times of events count that; unless the "
        "recording paused there, cut the video at that frame");
}

TEST(ClockJumps, AreCounted) {
    EXPECT_EQ(
        textOf({0, 60'000, 60'040, 120'000, 180'000}),
        "the clock of the video leaps ahead 3 times, before frames 1, 3 and 4 (by 1:00 the first time), and times "
        "of events count that; unless the recording paused there, cut the video at those frames");
    EXPECT_NE(textOf({0, 60'000, 120'000}).find("2 times, before frames 1 and 2 (by"), std::string::npos);
    EXPECT_NE(textOf({0, 60'000, 120'000, 180'000, 240'000}).find("4 times, before frames 1, 2, 3 and others (by"),
              std::string::npos);
}

TEST(ClockJumps, AreNoLostPicturesAndNoSlowCameras) {
    EXPECT_EQ(textOf({0, 40, 1'900, 1'940, 1'900, 1'940}), "");
    EXPECT_EQ(textOf({0, 5'000, 10'000, 40'000}, 0.2), "") << "a picture in five seconds, of which some were lost";
    EXPECT_NE(textOf({0, 5'000, 10'000, 70'000}, 0.2), "");
    EXPECT_EQ(textOf({}), "");
}

}  // namespace eyrie::clock_jumps_test
