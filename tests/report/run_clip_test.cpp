#include "report/clip/run_clip.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace eyrie::run_clip_test {
namespace {

/// Frames a quarter of a second apart, of which 40 are known: a later one is asked for by mistake.
double secondsOf(FrameIndex frame) {
    if (frame < 0 || frame >= 40) throw std::out_of_range("frame " + std::to_string(frame));
    return frame / 4.0;
}

FrameRange around(FrameRange event, double around_s, FrameRange whole = {0, 39}) {
    return framesAround(event, around_s, whole, secondsOf);
}

TEST(RunClip, HasWhatIsBeforeAndAfterAsFarAsTheRunGoes) {
    EXPECT_EQ(around({20, 24}, 1).first, 16);
    EXPECT_EQ(around({20, 24}, 1).last, 28);
    EXPECT_EQ(around({20, 20}, 0).first, 20);
    EXPECT_EQ(around({20, 20}, 0).last, 20);
    EXPECT_EQ(around({2, 37}, 5).first, 0);
    EXPECT_EQ(around({2, 37}, 5).last, 39);
    EXPECT_EQ(around({20, 20}, 1000, {10, 25}).first, 10);
    EXPECT_EQ(around({20, 20}, 1000, {10, 25}).last, 25);
}

TEST(RunClip, AnEventBeyondTheVideoIsBroughtIntoIt) {
    EXPECT_EQ(around({30, 90}, 1).last, 39);
    EXPECT_EQ(around({80, 90}, 1).first, 35);
    EXPECT_EQ(around({80, 90}, 1).last, 39);
}

}  // namespace
}  // namespace eyrie::run_clip_test
