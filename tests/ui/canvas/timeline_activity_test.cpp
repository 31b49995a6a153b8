#include "canvas/timeline/timeline_activity.h"

#include <QTest>
#include <algorithm>
#include <cmath>

#include "ui/support/ui_test.h"

namespace eyrie::ui::timeline_activity_test {

/// The curves of the timeline: what is drawn of few frames, and of many.
class TimelineActivityTest : public QObject {
    Q_OBJECT

    static TimelineAxis axis(int frames) {
        TimelineAxis axis;
        axis.setSpan(100, 500);
        axis.setFrameCount(frames);
        axis.showAll();
        return axis;
    }
    static TimelineFrame done(int tracks, int vectors) {
        TimelineFrame frame;
        frame.done = true;
        frame.tracks = tracks;
        frame.motion_vectors = vectors;
        return frame;
    }
    static TimelineActivity::Curves curvesOf(const std::vector<TimelineFrame>& frames, const TimelineAxis& axis) {
        const OverlayColours colours = overlayColours(PaletteKind::thesis);
        return TimelineActivity(frames, colours, QPalette()).curves(kRow, axis);
    }
    static constexpr QRectF kRow{100, 10, 500, 43};  ///< 40 px for the most of each

 private slots:
    void eachFrameHasAStepOfTheAreaAndAPointOfTheLine() {
        const auto curves = curvesOf({done(2, 10), done(4, 5), {}, done(1, 10)}, axis(4));  // 125 px a frame
        const QPolygonF area = curves.tracks.toSubpathPolygons().value(0);
        QCOMPARE(area, QPolygonF({{100, 53}, {100, 33}, {225, 33}, {225, 13}, {350, 13}, {350, 53}}));
        QCOMPARE(curves.tracks.toSubpathPolygons().value(1).at(1), QPointF(475, 43));
        const QList<QPolygonF> lines = curves.vectors.toSubpathPolygons();
        QCOMPARE(lines.size(), 1);  // nothing is known of the third frame, so that the fourth is a point by itself
        QCOMPARE(lines.front().first(), QPointF(162.5, 13));
        QCOMPARE(lines.front().last(), QPointF(287.5, 33));
    }

    void anHourIsNoMorePointsThanColumnsTakeAndKeepsItsExtremes() {
        std::vector<TimelineFrame> frames;
        for (int i = 0; i < 90'000; ++i) frames.push_back(done(10 + i % 3, 100 + i % 7));
        frames[40'000].tracks = 40;
        frames[50'000].motion_vectors = 400;
        frames[60'000].motion_vectors = 0;
        TimelineAxis whole = axis(90'000);
        const auto curves = curvesOf(frames, whole);
        QVERIFY(curves.tracks.elementCount() <= 2 * 501 + 3);
        QVERIFY(curves.vectors.elementCount() <= 2 * 501 + 3);
        QCOMPARE(curves.tracks.boundingRect().top(), 13.0);
        QCOMPARE(curves.vectors.boundingRect().top(), 13.0);
        QCOMPARE(curves.vectors.boundingRect().bottom(), 53.0);
        whole.zoomAround(350, 1000);  // only frames in view are drawn
        QVERIFY(curvesOf(frames, whole).tracks.elementCount() <= 2 * 100 + 3);
    }

    void oneFrameOfAColumnThatIsDoneIsDrawn() {
        std::vector<TimelineFrame> frames(90'000);
        frames[45'000] = done(3, 3);
        QVERIFY(!curvesOf(frames, axis(90'000)).tracks.isEmpty());
        QVERIFY(curvesOf(std::vector<TimelineFrame>(90'000), axis(90'000)).tracks.isEmpty());
    }
};

}  // namespace eyrie::ui::timeline_activity_test

EYRIE_UI_TEST(QApplication, timeline_activity_test, TimelineActivityTest)
#include "timeline_activity_test.moc"
