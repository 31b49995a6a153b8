#include "canvas/timeline/timeline_axis.h"

#include <QTest>
#include <cmath>

#include "ui/support/ui_test.h"

namespace eyrie::ui::timeline_axis_test {

class TimelineAxisTest : public QObject {
    Q_OBJECT

    static TimelineAxis axis(int frames, double left = 100, double width = 800) {
        TimelineAxis a;
        a.setSpan(left, width);
        a.setFrameCount(frames);
        return a;
    }
    static std::vector<std::int64_t> times(int frames, double rate) {
        std::vector<std::int64_t> result;
        for (int i = 0; i < frames; ++i) result.push_back(std::llround(i * 1e6 / rate));
        return result;
    }

 private slots:
    void allFramesFillTheSpan() {
        const TimelineAxis a = axis(200);
        QCOMPARE(a.xOf(0), 100.0);
        QCOMPARE(a.xOf(200), 900.0);
        QCOMPARE(a.frameAt(100), 0);
        QCOMPARE(a.frameAt(899.9), 199);
        QVERIFY(a.showsAll());
    }

    void everyFrameIsFoundUnderItsOwnCentre() {
        TimelineAxis a = axis(1234);
        a.zoomAround(333, 7);
        for (int f = a.firstVisible(); f <= a.lastVisible(); ++f) QCOMPARE(a.frameAt(a.centreOf(f)), f);
    }

    void placesOutsideGiveTheNearestFrame() {
        const TimelineAxis a = axis(50);
        QCOMPARE(a.frameAt(-1e9), 0);
        QCOMPARE(a.frameAt(1e9), 49);
        QCOMPARE(TimelineAxis().frameAt(5), 0);
    }

    void zoomKeepsTheFrameUnderTheCursor() {
        TimelineAxis a = axis(1000);
        const double x = 500;
        const int frame = a.frameAt(x);
        a.zoomAround(x, 4);
        QCOMPARE(a.frameAt(x), frame);
        QVERIFY(!a.showsAll());
        a.zoomAround(x, 1e-6);
        QVERIFY(a.showsAll());
    }

    void revealScrollsNoFurtherThanNeeded() {
        TimelineAxis a = axis(1000);
        a.zoomAround(100, 10);
        QCOMPARE(a.firstVisible(), 0);
        a.reveal(500);
        QVERIFY(a.xOf(501) <= a.right() + 1e-6 && a.xOf(500) >= a.left());
        const double first = a.xOf(0);
        a.reveal(490);  // visible already
        QCOMPARE(a.xOf(0), first);
    }

    void aPartFillsTheSpan() {
        TimelineAxis a = axis(1000);
        a.showFrames(400, 499);
        QCOMPARE(a.xOf(400), 100.0);
        QCOMPARE(a.xOf(500), 900.0);
        a.showFrames(600, 601);  // few are not blown up
        QCOMPARE(a.pixelsPerFrame(), TimelineAxis::kMaxPixelsPerFrame);
        QCOMPARE(a.xOf(601), 500.0);
        a.showFrames(990, 1010);
        QCOMPARE(a.lastVisible(), 999);
        QVERIFY(a.xOf(990) >= a.left() && std::abs(a.xOf(1000) - a.right()) < 1e-6);
        a.showFrames(-20, 2000);
        QVERIFY(a.showsAll());
    }

    void panningStopsAtTheEnds() {
        TimelineAxis a = axis(1000);
        a.zoomAround(500, 5);
        a.panBy(1e9);
        QCOMPARE(a.firstVisible(), 0);
        a.panBy(-1e9);
        QCOMPARE(a.lastVisible(), 999);
    }

    void widerWindowStillShowsAll() {
        TimelineAxis a = axis(300);
        a.setSpan(50, 1200);
        QVERIFY(a.showsAll());
        QCOMPARE(a.xOf(300), 1250.0);
    }

    void ticksStandAtRoundTimesFarEnoughApart() {
        const TimelineAxis a = axis(401);
        const auto t = times(401, 25);
        const auto ticks = a.ticks(t, 80);
        double last_x = -1e9;
        int labelled = 0;
        for (const TimelineTick& tick : ticks) {
            // 401 frames of 40 ms over 800 px: a label every 2 s is the first round step of 80 px.
            QCOMPARE(tick.time_us % 400'000, 0);
            if (!tick.labelled) continue;
            QCOMPARE(tick.time_us % 2'000'000, 0);
            QVERIFY(tick.x - last_x >= 79);
            last_x = tick.x;
            ++labelled;
        }
        QCOMPARE(labelled, 9);  // 0 s … 16 s
    }

    void ticksStandAtRoundTimesOfTheDay() {
        const TimelineAxis a = axis(401);
        constexpr std::int64_t kBegin_us = 1'231'798'102'340'000;
        int labelled = 0;
        for (const TimelineTick& tick : a.ticks(times(401, 25), 80, kBegin_us)) {
            if (!tick.labelled) continue;
            QCOMPARE((tick.time_us + kBegin_us) % 2'000'000, 0);
            QVERIFY(tick.time_us >= 0);
            ++labelled;
        }
        QCOMPARE(labelled, 8);  // from 1.66 s on, every 2 s of 16 s
    }

    void labelsKeepApartWherePicturesAreMissing() {
        std::vector<std::int64_t> t;
        for (int i = 0; i < 100; ++i) t.push_back((i + i / 10 * 30) * 40'000);  // ten are there, thirty are not
        double last_x = -1e9;
        int labelled = 0;
        for (const TimelineTick& tick : axis(100).ticks(t, 80)) {
            if (!tick.labelled) continue;
            QVERIFY2(tick.x - last_x >= 79, qPrintable(QString::number(tick.x)));
            last_x = tick.x;
            ++labelled;
        }
        QVERIFY(labelled >= 5);
    }

    void ticksFollowTrueTimesOfAVariableRate() {
        // The second half runs at half the rate: a tick at a frame's time stands at that frame.
        std::vector<std::int64_t> t;
        for (int i = 0; i < 50; ++i) t.push_back(i * 20'000);
        for (int i = 0; i < 50; ++i) t.push_back(1'000'000 + i * 40'000);
        const TimelineAxis a = axis(100);
        bool found = false;
        for (const TimelineTick& tick : a.ticks(t, 80))
            if (tick.time_us == 2'000'000) {
                QVERIFY(std::abs(tick.x - a.xOf(75)) < 1e-6);
                found = true;
            }
        QVERIFY(found);
    }
};

}  // namespace eyrie::ui::timeline_axis_test

EYRIE_UI_TEST(QCoreApplication, timeline_axis_test, TimelineAxisTest)
#include "timeline_axis_test.moc"
