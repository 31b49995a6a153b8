#include "core/review/seen_frames.h"

#include <gmock/gmock.h>

namespace eyrie::seen_frames_test {

/// For messages of failed tests.
inline void PrintTo(const FrameSpan& span, std::ostream* out) {
    *out << span.first << '-' << span.last;
}

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Shows frames at 25 Hz for some seconds, at a multiple of the speed and 50 pictures a second.
struct Player {
    SeenRecorder recorder;
    double wall_s = 100;
    double video_s = 0;

    void play(double speed, double seconds) {
        for (int i = 0; i <= seconds * 50; ++i) {
            recorder.show(static_cast<int>(video_s * 25 + 1e-6), video_s, wall_s);
            wall_s += 0.02;
            video_s += speed * 0.02;
        }
    }
};

TEST(SeenFrames, SpansThatMeetAreOne) {
    EXPECT_THAT(mergedSpans({{5, 9}, {0, 4}, {20, 30}, {25, 26}, {12, 11}}),
                ElementsAre(FrameSpan{0, 9}, FrameSpan{20, 30}));
    EXPECT_EQ(framesIn({{0, 9}, {20, 30}}), 21);
    EXPECT_DOUBLE_EQ(seenShare({{0, 9}, {20, 30}}, {5, 24}), 0.5);
    EXPECT_DOUBLE_EQ(seenShare({{0, 9}}, {5, 4}), 0);
}

TEST(SeenFrames, ASpanMayBeOneFrameAndAGapToo) {
    EXPECT_THAT(mergedSpans({{7, 7}}), ElementsAre(FrameSpan{7, 7}));
    EXPECT_THAT(mergedSpans({{6, 9}, {0, 4}}), ElementsAre(FrameSpan{0, 4}, FrameSpan{6, 9})) << "nobody saw frame 5";
    EXPECT_THAT(mergedSpans({}), IsEmpty());
    EXPECT_DOUBLE_EQ(seenShare({{5, 5}}, {5, 5}), 1);
    EXPECT_DOUBLE_EQ(seenShare({{0, 1}, {50, 60}}, {10, 19}), 0) << "seen elsewhere";
    EXPECT_DOUBLE_EQ(seenShare({{0, 100}}, {10, 19}), 1);
}

/// What is seen of steps of a length in the video, ten pictures a second, until the speed was measured once.
std::vector<FrameSpan> seenBySteps(double step_s, int steps) {
    SeenRecorder recorder;
    for (int i = 0; i <= steps; ++i) recorder.show(i, i * step_s, 10 + i * 0.1);
    return recorder.take();
}

TEST(SeenFrames, SpeedsAreMeasuredOverHalfASecondAndWithATwentiethOfSlack) {
    EXPECT_THAT(seenBySteps(0.1, 4), IsEmpty()) << "too short to tell";
    EXPECT_EQ(seenBySteps(0.1, 6).size(), 1U);
    EXPECT_EQ(seenBySteps(0.415, 6).size(), 1U);
    EXPECT_THAT(seenBySteps(0.425, 6), IsEmpty());
}

TEST(SeenFrames, AStepOfMoreThanHalfASecondIsALeap) {
    const auto seenAfterStep = [](double step_s) {
        SeenRecorder recorder;
        recorder.show(0, 0, 10);
        recorder.show(1, 0.04, 10.3);  // what stands for half a second is joined by no leap at all
        recorder.show(15, 0.04 + step_s, 10.6);
        recorder.interrupt(10.7);
        return recorder.take();
    };
    EXPECT_THAT(seenAfterStep(0.4), ElementsAre(FrameSpan{0, 15}));
    EXPECT_THAT(seenAfterStep(0.6), ElementsAre(FrameSpan{0, 1}));
}

TEST(SeenFrames, UpToFourTimesTheSpeedIsSeenFasterIsNot) {
    for (const double speed : {0.25, 1.0, 4.0, -2.0}) {
        Player player;
        player.video_s = 20;
        player.play(speed, 4);
        player.recorder.interrupt(player.wall_s);
        const auto seen = player.recorder.take();
        ASSERT_EQ(seen.size(), 1U) << speed;
        EXPECT_GE(framesIn(seen), std::abs(speed) * 3.4 * 25) << speed;
        EXPECT_LE(framesIn(seen), std::abs(speed) * 4.1 * 25 + 1) << speed;
        EXPECT_THAT(player.recorder.take(), IsEmpty()) << "told once";
    }
    for (const double speed : {8.0, 32.0}) {
        Player player;
        player.play(speed, 4);
        player.recorder.interrupt(player.wall_s);
        EXPECT_THAT(player.recorder.take(), IsEmpty()) << speed;
    }
}

TEST(SeenFrames, LeapsSeeNothingBetween) {
    Player player;
    player.play(1, 2);
    player.video_s = 60;
    player.play(1, 2);
    player.recorder.interrupt(player.wall_s);
    EXPECT_THAT(player.recorder.take(),
                ElementsAre(testing::Field(&FrameSpan::first, 0), testing::Field(&FrameSpan::first, 1500)));
}

TEST(SeenFrames, AStillPictureCountsOnceItStays) {
    SeenRecorder recorder;
    recorder.show(40, 1.6, 10);
    recorder.show(400, 16, 10.1);
    recorder.show(900, 36, 14);
    recorder.interrupt(14.1);
    EXPECT_THAT(recorder.take(), ElementsAre(FrameSpan{400, 400}));
}

TEST(SeenFrames, GoingFromEventToEventIsNoPlaying) {
    SeenRecorder recorder;
    // Events a third of a second apart, each looked at for a second.
    for (int i = 0; i < 5; ++i) recorder.show(10 * i, 10 * i / 30.0, 100 + i);
    recorder.interrupt(105);
    EXPECT_THAT(recorder.take(), ElementsAre(FrameSpan{0, 0}, FrameSpan{10, 10}, FrameSpan{20, 20}, FrameSpan{30, 30},
                                             FrameSpan{40, 40}));
    // The next frame joins one that stood, either way, however short it was looked at itself.
    for (const int next : {61, 60, 59, 62, 58}) {
        recorder.show(60, 2.4, 150);
        recorder.show(next, next * 0.04, 152);
        recorder.interrupt(152.1);
        const bool joins = std::abs(next - 60) <= 1;
        EXPECT_THAT(recorder.take(),
                    ElementsAre(joins ? FrameSpan{std::min(60, next), std::max(60, next)} : FrameSpan{60, 60}))
            << next;
    }
    // Stepping is: each frame was looked at.
    for (int i = 0; i < 5; ++i) recorder.show(100 - i, (100 - i) / 30.0, 200 + i);
    recorder.interrupt(205);
    EXPECT_THAT(recorder.take(), ElementsAre(FrameSpan{96, 100}));
}

TEST(SeenFrames, TheTimeBehindAnotherWindowConnectsNothing) {
    SeenRecorder recorder;
    recorder.show(10, 0.4, 10);
    recorder.interrupt(11);
    recorder.show(20, 0.8, 500);
    recorder.interrupt(501);
    EXPECT_THAT(recorder.take(), ElementsAre(FrameSpan{10, 10}, FrameSpan{20, 20}));
}

}  // namespace
}  // namespace eyrie::seen_frames_test
