#include "canvas/timeline/timeline_view.h"

#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>
#include <cmath>

#include "ui/support/ui_test.h"

namespace eyrie::ui::timeline_view_test {

class TimelineViewTest : public QObject {
    Q_OBJECT

    static std::vector<std::int64_t> times(int count) {
        std::vector<std::int64_t> result;
        for (int i = 0; i < count; ++i) result.push_back(i * 40'000);
        return result;
    }
    static QPoint at(const TimelineView& view, FrameIndex frame) {
        return {static_cast<int>(view.axis().centreOf(frame)), view.height() / 2};
    }

 private slots:
    void clickingAndDraggingScrubs() {
        TimelineView view;
        view.resize(1000, 104);
        view.setTimes(times(100));
        std::vector<FrameIndex> requested;
        connect(&view, &TimelineView::frameRequested, this,
                [&](FrameIndex frame, bool) { requested.push_back(frame); });
        QTest::mousePress(&view, Qt::LeftButton, {}, at(view, 20));
        QTest::mouseMove(&view, at(view, 55));
        QTest::mouseRelease(&view, Qt::LeftButton, {}, at(view, 60));
        QCOMPARE(requested, (std::vector<FrameIndex>{20, 55, 60}));
    }

    void twoClicksOnTheNamesShowAllAndGoNowhere() {
        TimelineView view;
        view.resize(1000, 104);
        view.setTimes(times(1000));
        view.setCurrentFrame(600);
        view.zoomBy(20);
        QVERIFY(!view.axis().showsAll());
        const QSignalSpy requested(&view, &TimelineView::frameRequested);
        const QPoint names(static_cast<int>(view.axis().left()) / 2, 60);
        QTest::mouseClick(&view, Qt::LeftButton, {}, names);
        QTest::mouseDClick(&view, Qt::LeftButton, {}, names);
        QVERIFY(view.axis().showsAll());
        QVERIFY(requested.isEmpty());
        // Just beside the first frame is on it.
        QTest::mouseClick(&view, Qt::LeftButton, {}, QPoint(static_cast<int>(view.axis().left()) - 3, 60));
        QCOMPARE(requested.size(), 2);
        QCOMPARE(requested.front().front().toInt(), 0);
    }

    void wheelZoomsAroundTheCursor() {
        TimelineView view;
        view.resize(1000, 104);
        view.setTimes(times(1000));
        const QPointF cursor = at(view, 600);
        const FrameIndex under = view.axis().frameAt(cursor.x());
        QWheelEvent event(cursor, cursor, {}, {0, 600}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(&view, &event);
        QCOMPARE(view.axis().frameAt(cursor.x()), under);
        QVERIFY(!view.axis().showsAll());
    }

    void itZoomsByTimeAndNotByCountsOfFrames() {
        TimelineView view;
        view.resize(700, 104);
        // One second of 100 Hz, then one frame a second.
        std::vector<std::int64_t> uneven;
        for (int frame = 0; frame < 100; ++frame) uneven.push_back(frame * 10'000);
        for (int second = 1; second <= 100; ++second) uneven.push_back(second * 1'000'000);
        view.setTimes(uneven);
        view.showAround(150, 160, 5'000'000);
        const TimelineAxis& axis = view.axis();
        QVERIFY(std::abs(axis.xOf(145) - axis.left()) < 1e-6 && std::abs(axis.xOf(166) - axis.right()) < 1e-6);
        view.showAll();
        QVERIFY(axis.showsAll());
    }

    void qualityHasAColourPerState() {
        const auto colour = [](RegistrationState state, double rms) {
            return qualityColour({.done = true, .state = state, .rms_px = rms});
        };
        const QColor good = colour(RegistrationState::registered, 0.02);
        const QColor poor = colour(RegistrationState::registered, 0.6);
        const QColor failed = colour(RegistrationState::failed, 0);
        const QColor frozen = colour(RegistrationState::frozen, 0);
        QVERIFY(good.green() > good.red());
        QVERIFY(poor.red() > poor.green());
        QVERIFY(failed.red() > 2 * failed.green());
        QVERIFY(frozen.blue() > frozen.red());
    }

    void aFailedFrameIsSeenEvenAmongManyInOneColumn() {
        TimelineView view;
        view.resize(400, 104);
        view.setTimes(times(20000));
        std::vector<TimelineFrame> frames(20000, {.done = true,
                                                  .state = RegistrationState::registered,
                                                  .rms_px = 0.05,
                                                  .inliers = 90,
                                                  .corners = 100,
                                                  .motion_vectors = 10,
                                                  .tracks = 3});
        frames[7003].state = RegistrationState::failed;
        view.setFrames(frames);
        const QImage picture = view.grab().toImage();
        int red = 0;
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x)
                if (picture.pixelColor(x, y) == qualityColour(frames[7003])) ++red;
        QVERIFY(red > 0);
    }

    void framesOfARunningRunAppearOneByOne() {
        TimelineView view;
        view.resize(600, 104);
        view.setTimes(times(50));
        view.setRunRange(std::pair(0, 49));
        const QImage before = view.grab().toImage();
        view.setFrameDone(10, {.done = true, .state = RegistrationState::registered, .corners = 10, .tracks = 2});
        QVERIFY(before != view.grab().toImage());
    }

    void framesOfALiveSourceStandThereWhenItsLengthIsTold() {
        TimelineView view;
        view.resize(600, 104);
        view.setTimes(times(50));
        view.setRunRange(std::pair(0, 49));
        for (int frame = 0; frame < 60; ++frame)
            view.setFrameDone(frame,
                              {.done = true, .state = RegistrationState::registered, .corners = 10, .tracks = 2});
        const QImage shorter = view.grab().toImage();
        view.setRunRange(std::pair(0, 59));
        view.extendTimes(times(60));
        const QImage grown = view.grab().toImage();
        TimelineView whole;
        whole.resize(600, 104);
        whole.setTimes(times(60));
        whole.setRunRange(std::pair(0, 59));
        whole.setFrames(std::vector<TimelineFrame>(
            60, {.done = true, .state = RegistrationState::registered, .corners = 10, .tracks = 2}));
        QVERIFY(shorter != grown);
        QCOMPARE(grown, whole.grab().toImage());
    }

    void seamsStandWhereTheirFramesBeginAndNotTooDense() {
        TimelineAxis axis;
        axis.setSpan(100, 1000);
        axis.setFrameCount(1000);
        axis.showAll();
        QCOMPARE(TimelineSeams({600, 200}).places(axis), (std::vector<double>{300.5, 700.5}));
        QCOMPARE(TimelineSeams({200, 201, 202, 203}).places(axis), (std::vector<double>{300.5, 303.5}));
        axis.zoomAround(100, 2);
        QCOMPARE(TimelineSeams({200, 600}).places(axis), (std::vector<double>{500.5}));
        QVERIFY(TimelineSeams().places(axis).empty());
    }

    void seamsAreDrawnUntilAnotherVideoComes() {
        TimelineView view;
        view.resize(600, 104);
        view.setTimes(times(50));
        const QImage before = view.grab().toImage();
        view.setSeams({20, 40});
        const QImage with = view.grab().toImage();
        const int x = static_cast<int>(view.axis().xOf(20));
        QVERIFY(with.copy(x - 1, 0, 3, 104) != before.copy(x - 1, 0, 3, 104));
        QCOMPARE(with.copy(x + 5, 0, 30, 104), before.copy(x + 5, 0, 30, 104));
        view.setTimes(times(50));
        QCOMPARE(view.grab().toImage(), before);
    }

    void theRulerHasTheTimeOfTheDayWhereItIsKnown() {
        TimelineView view;
        view.resize(600, 104);
        view.setTimes(times(50));
        const QImage before = view.grab().toImage();
        QCOMPARE(view.rulerText(1'000'000), QStringLiteral("0:01"));
        view.setClock([](std::int64_t video_us) { return std::optional(1'231'798'102'000'000 + video_us); });
        QCOMPARE(view.rulerText(1'000'000), QStringLiteral("22:08:23"));
        QCOMPARE(view.rulerText(1'500'000, 1), QStringLiteral("22:08:23.5"));
        // A tick lies at a round time but for what the clock is rounded by.
        QCOMPARE(view.rulerText(999'999), QStringLiteral("22:08:23"));
        QCOMPARE(view.rulerText(1'499'998, 1), QStringLiteral("22:08:23.5"));
        QCOMPARE(view.rulerText(57'999'999, 2), QStringLiteral("22:09:20.00"));
        QVERIFY(view.grab().toImage() != before);
        view.setClock([](std::int64_t) { return std::optional<std::int64_t>(); });
        QCOMPARE(view.rulerText(1'000'000), QString());
        view.setClock({});
        QCOMPARE(view.grab().toImage(), before);
    }

    void whatWasWatchedHasARowWhileThatIsKnown() {
        TimelineView view;
        const int height = view.sizeHint().height();
        view.setTimes(times(100));
        view.setWatched(std::vector<FrameSpan>());
        QVERIFY(view.sizeHint().height() > height);
        view.resize(600, view.sizeHint().height());
        const QImage none = view.grab().toImage();
        view.setWatched(std::vector<FrameSpan>{{20, 39}, {60, 60}});
        const QImage some = view.grab().toImage();
        const auto differs = [&](double frame) {
            const int x = static_cast<int>(view.axis().xOf(frame));
            return some.copy(x, 0, 1, some.height()) != none.copy(x, 0, 1, none.height());
        };
        QVERIFY(differs(25) && differs(39.5) && differs(60.5));
        QVERIFY(!differs(10) && !differs(50) && !differs(80));
        view.setTimes(times(100));
        QCOMPARE(view.sizeHint().height(), height);
    }

    void whereRoomIsScarceItHasTimesAndRegistrationAlone() {
        TimelineView view;
        view.setTimes(times(100));
        view.setWatched(std::vector<FrameSpan>{{20, 39}});
        view.setTrackLife(std::pair(10, 50), QStringLiteral("Track 7"));
        const int whole = view.sizeHint().height();
        view.setBrief(true);
        QVERIFY(view.sizeHint().height() < whole / 2);
        QCOMPARE(view.minimumSizeHint().height(), view.sizeHint().height());
        view.resize(600, view.sizeHint().height());
        const QImage before = view.grab().toImage();
        view.setTrackLife(std::pair(60, 90), QStringLiteral("Track 8"));
        view.setWatched(std::vector<FrameSpan>{{70, 80}});
        QCOMPARE(view.grab().toImage(), before);
        view.setCurrentFrame(50);
        QVERIFY(view.grab().toImage() != before);
        view.setBrief(false);
        QCOMPARE(view.sizeHint().height(), whole);
    }

    void withoutAVideoItIsEmptyAndHarmless() {
        TimelineView view;
        view.resize(600, 104);
        QSignalSpy requested(&view, &TimelineView::frameRequested);
        QTest::mouseClick(&view, Qt::LeftButton, {}, {300, 50});
        QCOMPARE(requested.count(), 0);
        view.grab();
    }
};

}  // namespace eyrie::ui::timeline_view_test

EYRIE_UI_TEST(QApplication, timeline_view_test, TimelineViewTest)
#include "timeline_view_test.moc"
