#include "session/frames/playback_clock.h"

#include <QTest>

#include "ui/support/ui_test.h"

namespace eyrie::ui::playback_clock_test {

class PlaybackClockTest : public QObject {
    Q_OBJECT

    static PlaybackClock clockOf(std::vector<std::int64_t> times) {
        PlaybackClock clock;
        clock.setTimes(std::move(times));
        return clock;
    }

 private slots:
    void playsByTheVideosOwnTimes() {
        // Variable rate: frames last 40, 10, 100 and (as the one before) 100 ms.
        PlaybackClock clock = clockOf({0, 40'000, 50'000, 150'000});
        clock.start(0, 1, 1'000'000);
        QCOMPARE(clock.frameAt(1'000'000), 0);
        QCOMPARE(clock.frameAt(1'039'999), 0);
        QCOMPARE(clock.frameAt(1'040'000), 1);
        QCOMPARE(clock.frameAt(1'050'000), 2);
        QCOMPARE(clock.frameAt(1'149'000), 2);
        QCOMPARE(clock.frameAt(1'150'000), 3);
        QVERIFY(!clock.ended(1'249'000));
        QVERIFY(clock.ended(1'250'000));
    }

    void doesNotWaitWhereTheClockLeapsAhead() {
        constexpr std::int64_t kHour_us = 3'600'000'000;
        PlaybackClock clock = clockOf({0, 40'000, 80'000, kHour_us, kHour_us + 40'000, kHour_us + 80'000});
        clock.start(0, 1, 0);
        QCOMPARE(clock.frameAt(119'000), 2);
        QCOMPARE(clock.frameAt(121'000), 3);
        QCOMPARE(clock.frameAt(161'000), 4);
        QVERIFY(clock.ended(241'000));
    }

    void speedScalesTime() {
        PlaybackClock clock = clockOf({0, 40'000, 80'000, 120'000});
        clock.start(1, 4, 0);
        QCOMPARE(clock.frameAt(10'000), 2);
        clock.start(1, 0.25, 0);
        QCOMPARE(clock.frameAt(159'000), 1);
        QCOMPARE(clock.frameAt(160'000), 2);
    }

    void playsBackwardsToTheFirstFrame() {
        PlaybackClock clock = clockOf({0, 40'000, 80'000, 120'000});
        clock.start(2, -1, 0);
        QCOMPARE(clock.frameAt(0), 2);
        QCOMPARE(clock.frameAt(41'000), 1);
        QCOMPARE(clock.frameAt(81'000), 0);
        QVERIFY(!clock.ended(110'000));
        QVERIFY(clock.ended(121'000));
        QCOMPARE(clock.frameAt(500'000), 0);
    }

    void waitingAsLongAsItSaysGivesTheNextFrame() {
        for (const double speed : {1.0, 0.25, 8.0, -1.0, -2.0}) {
            PlaybackClock clock = clockOf({0, 33'367, 66'733, 100'100, 133'467, 166'833});
            const FrameIndex from = speed > 0 ? 0 : 5;
            clock.start(from, speed, 5);
            std::int64_t now = 5;
            for (int i = 1; i < 5; ++i) {
                now += clock.untilNext(now);
                QCOMPARE(clock.frameAt(now), speed > 0 ? i : 5 - i);
            }
        }
    }

    void withoutFramesItEndsAtOnce() {
        PlaybackClock clock;
        clock.start(3, 1, 0);
        QCOMPARE(clock.frameAt(100), 0);
        QVERIFY(clock.ended(0));
        QVERIFY(clock.untilNext(0) > 0);
    }
};

}  // namespace eyrie::ui::playback_clock_test

EYRIE_UI_TEST(QCoreApplication, playback_clock_test, PlaybackClockTest)
#include "playback_clock_test.moc"
