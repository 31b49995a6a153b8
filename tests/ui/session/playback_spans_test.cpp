#include <QTest>
#include <algorithm>

#include "session/frames/playback.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::playback_spans_test {

/// Playing some stretches of a video alone.
class PlaybackSpansTest : public QObject {
    Q_OBJECT

    /// Slow enough that a busy machine does not miss the first frame of a stretch.
    static constexpr double kSpeed = 8;

    /// The frames that are shown from one on, of a video of 100 frames.
    static std::vector<FrameIndex> played(Playback& playback, FrameIndex from) {
        std::vector<FrameIndex> frames;
        QObject receiver;
        connect(&playback, &Playback::frameDue, &receiver, [&](FrameIndex frame) { frames.push_back(frame); });
        playback.play(from);
        [&] { QTRY_VERIFY_WITH_TIMEOUT(!playback.playing(), 60'000); }();
        return frames;
    }
    static void prepare(Playback& playback, std::vector<FrameSpan> spans) {
        std::vector<std::int64_t> times;
        for (int frame = 0; frame < 100; ++frame) times.push_back(frame * std::int64_t{20'000});
        playback.setTimes(times);
        playback.setSpeed(kSpeed, 0);
        playback.setSpans(std::move(spans));
    }

 private slots:
    void whatLiesBetweenIsLeaptOver() {
        Playback playback;
        prepare(playback, {{10, 19}, {70, 79}});
        const auto frames = played(playback, 0);
        QVERIFY(!frames.empty());
        QCOMPARE(frames.front(), 10);
        QVERIFY(std::is_sorted(frames.begin(), frames.end()));
        QVERIFY(std::find_if(frames.begin(), frames.end(), [](int f) { return f >= 70; }) != frames.end());
        for (const int frame : frames) QVERIFY((frame >= 10 && frame <= 19) || (frame >= 70 && frame <= 79));
    }

    void backwardsToo() {
        Playback playback;
        prepare(playback, {{10, 19}, {70, 79}});
        playback.setSpeed(-kSpeed, 0);
        const auto frames = played(playback, 99);
        QVERIFY(!frames.empty());
        QCOMPARE(frames.front(), 79);
        QVERIFY(std::is_sorted(frames.rbegin(), frames.rend()));
        for (const int frame : frames) QVERIFY((frame >= 10 && frame <= 19) || (frame >= 70 && frame <= 79));
    }

    void behindTheLastStretchItBeginsAnew() {
        Playback playback;
        prepare(playback, {{10, 19}});
        QCOMPARE(played(playback, 50).front(), 10);
    }

    void whereNothingIsToBePlayedItEndsAtOnce() {
        Playback playback;
        prepare(playback, {});
        QVERIFY(played(playback, 50).empty());
        playback.setLooping(true);
        QVERIFY(played(playback, 50).empty());
    }

    void withoutStretchesAllIsPlayed() {
        Playback playback;
        prepare(playback, {});
        playback.setSpans(std::nullopt);
        QCOMPARE(played(playback, 90).back(), 99);
    }
};

}  // namespace eyrie::ui::playback_spans_test

EYRIE_UI_TEST(QCoreApplication, playback_spans_test, PlaybackSpansTest)
#include "playback_spans_test.moc"
