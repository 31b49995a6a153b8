#include "canvas/timeline/timeline_marks.h"

#include <QSignalSpy>
#include <QTest>
#include <set>

#include "canvas/timeline/timeline_view.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::timeline_marks_test {

/// Marks on the timeline: what is drawn of many, and what a click finds.
class TimelineMarksTest : public QObject {
    Q_OBJECT

    static TimelineMark mark(int id, FrameIndex frame, int weight = 0) {
        return {id, frame, weight > 0 ? QColor(Qt::red) : QColor(Qt::gray), weight};
    }
    static TimelineAxis axis(int frames) {
        TimelineAxis axis;
        axis.setSpan(100, 500);
        axis.setFrameCount(frames);
        axis.showAll();
        return axis;
    }

 private slots:
    void ofMarksInOneColumnTheHeaviestIsDrawn() {
        const TimelineMarks marks({mark(1, 4000), mark(2, 4001, 1), mark(3, 4002), mark(4, 9000)});
        const auto strokes = marks.strokes(axis(100'000));
        QCOMPARE(strokes.size(), std::size_t(2));
        QCOMPARE(strokes.front().colour, QColor(Qt::red));
        QCOMPARE(strokes.back().colour, QColor(Qt::gray));
    }

    void tenThousandMarksAreNoMoreStrokesThanColumns() {
        std::vector<TimelineMark> many;
        for (int i = 0; i < 10'000; ++i) many.push_back(mark(i + 1, 9 * i));
        const TimelineMarks marks(std::move(many));
        TimelineAxis whole = axis(90'000);
        const auto strokes = marks.strokes(whole);
        QVERIFY(strokes.size() <= 501);
        std::set<double> columns;
        for (const auto& stroke : strokes) columns.insert(stroke.x);
        QCOMPARE(columns.size(), strokes.size());
        whole.zoomAround(350, 1000);  // only marks in view are looked at
        QVERIFY(marks.strokes(whole).size() <= 20);
    }

    void theNearestMarkIsFound() {
        const TimelineMarks marks({mark(1, 10), mark(2, 20), mark(3, 20, 1)});
        const TimelineAxis some = axis(100);
        QCOMPARE(marks.nearest(some.centreOf(10) + 2, some, 5)->id, 1);
        QCOMPARE(marks.nearest(some.centreOf(20), some, 5)->id, 3);
        QVERIFY(marks.nearest(some.centreOf(50), some, 5) == nullptr);
        QCOMPARE(marks.find(2)->frame, 20);
        QVERIFY(marks.find(9) == nullptr);
    }

    void aClickOnAMarkTellsWhichAndDoesNotScrub() {
        TimelineView view;
        const int plain = view.sizeHint().height();
        std::vector<std::int64_t> times;
        for (int i = 0; i < 100; ++i) times.push_back(i * 40'000);
        view.setTimes(times);
        view.setMarks(QStringLiteral("Events"), {mark(7, 30, 1)});
        QVERIFY(view.sizeHint().height() > plain);  // its row takes no room from the others
        view.resize(1000, view.sizeHint().height());
        view.show();
        QSignalSpy clicked(&view, &TimelineView::markClicked);
        QSignalSpy scrubbed(&view, &TimelineView::frameRequested);
        const auto place = view.placeOfMark(7);
        QVERIFY(place);
        QTest::mouseClick(&view, Qt::LeftButton, {}, place->toPoint());
        QCOMPARE(clicked.count(), 1);
        QCOMPARE(clicked.front().front().toInt(), 7);
        QCOMPARE(scrubbed.count(), 0);
        QTest::mouseClick(&view, Qt::LeftButton, {}, place->toPoint() + QPoint(100, 0));
        QCOMPARE(clicked.count(), 1);
        QVERIFY(scrubbed.count() > 0);
        QCOMPARE(view.grab().toImage().pixelColor(place->toPoint()), QColor(Qt::red));
        view.setMarks({}, {});
        QCOMPARE(view.sizeHint().height(), plain);
    }
};

}  // namespace eyrie::ui::timeline_marks_test

EYRIE_UI_TEST(QApplication, timeline_marks_test, TimelineMarksTest)
#include "timeline_marks_test.moc"
