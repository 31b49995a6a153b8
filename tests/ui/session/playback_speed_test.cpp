#include <QTest>
#include <QThread>
#include <algorithm>

#include "session/frames/playback.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::playback_speed_test {

/// How fast a video may be played.
class PlaybackSpeedTest : public QObject {
    Q_OBJECT

 private slots:
    void speedsReachFromAQuarterToThirtyTwo() {
        Playback playback;
        for (const double way : {1.0, -1.0}) {
            playback.setSpeed(way * 100, 0);
            QCOMPARE(playback.speed(), way * 32);
            playback.setSpeed(way * 0.01, 0);
            QCOMPARE(playback.speed(), way * 0.25);
        }
    }

    void whoShowsSlowlyGetsFewerFramesAndNoLongerVideo() {
        constexpr int kFrames = 480;  // 19.2 s of 25 Hz: 0.6 s
        constexpr int kShowing_ms = 20;
        Playback playback;
        std::vector<std::int64_t> times;
        for (int frame = 0; frame < kFrames; ++frame) times.push_back(frame * std::int64_t{40'000});
        playback.setTimes(times);
        playback.setSpeed(32, 0);
        std::vector<FrameIndex> frames;
        QObject receiver;
        connect(&playback, &Playback::frameDue, &receiver, [&](FrameIndex frame) {
            frames.push_back(frame);
            QThread::msleep(kShowing_ms);
        });
        playback.play(0);
        QTRY_VERIFY_WITH_TIMEOUT(!playback.playing(), 60'000);
        QVERIFY(std::is_sorted(frames.begin(), frames.end()));
        QCOMPARE(frames.back(), kFrames - 1);
        // Each is shown for as long as that takes, and the others are left out.
        QVERIFY2(frames.size() <= 600 / kShowing_ms + 2, qPrintable(QString::number(frames.size())));
    }

    /// Nobody is asked more often than screens show.
    void aQuickScreenIsNotAskedForEveryFrame() {
        Playback playback;
        std::vector<std::int64_t> times;
        for (int frame = 0; frame < 480; ++frame) times.push_back(frame * std::int64_t{40'000});
        playback.setTimes(times);
        playback.setSpeed(32, 0);
        int asked = 0;
        QObject receiver;
        connect(&playback, &Playback::frameDue, &receiver, [&] { ++asked; });
        playback.play(0);
        QTRY_VERIFY_WITH_TIMEOUT(!playback.playing(), 60'000);
        QVERIFY2(asked <= 120, qPrintable(QString::number(asked)));
    }
};

}  // namespace eyrie::ui::playback_speed_test

EYRIE_UI_TEST(QCoreApplication, playback_speed_test, PlaybackSpeedTest)
#include "playback_speed_test.moc"
