#include "canvas/timeline/timeline_kinds.h"

#include <QHelpEvent>
#include <QSignalSpy>
#include <QTest>
#include <QToolTip>
#include <memory>

#include "canvas/timeline/timeline_view.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::timeline_kinds_test {

/// Rows of the kinds of what happened: what is drawn of many, what a place tells, what a click finds, and folding.
class TimelineKindsTest : public QObject {
    Q_OBJECT

    static TimelineAxis axis(int frames) {
        TimelineAxis axis;
        axis.setSpan(100, 500);
        axis.setFrameCount(frames);
        axis.showAll();
        return axis;
    }
    static TimelineKind kind(const QString& name, std::vector<TimelineHappening> happenings) {
        return {name, QColor(0, 60, 120), QColor(120, 200, 255), BarShape::full_height, std::move(happenings)};
    }
    static TimelineKind severalOf(const QString& name, int count) {
        TimelineKind several = kind(name, {});
        for (int i = 0; i < count; ++i) several.happenings.push_back({i + 1, i, i});
        return several;
    }
    static std::vector<TimelineKind> stopsAndStands() {
        return {kind(QStringLiteral("Stops"), {{1, 10, 10}, {2, 11, 11}, {3, 80, 80}}),
                kind(QStringLiteral("Turns"), {}), kind(QStringLiteral("Stands"), {{4, 10, 50}})};
    }
    static std::unique_ptr<TimelineView> viewOf(std::vector<TimelineKind> kinds) {
        auto view = std::make_unique<TimelineView>();
        std::vector<std::int64_t> times;
        for (int i = 0; i < 100; ++i) times.push_back(i * 40'000);
        view->setTimes(times);
        view->setMarks(QStringLiteral("Events"), {{1, 10, QColor(Qt::red), 1}});
        view->setKinds(std::move(kinds));
        view->resize(1000, view->sizeHint().height());
        view->show();
        return view;
    }

 private slots:
    void kindsThatOccurHaveARow() {
        const TimelineKinds kinds(stopsAndStands());
        QCOMPARE(kinds.rowCount(), 2);
        QCOMPARE(kinds.nameOf(0), QStringLiteral("Stops"));
        QCOMPARE(kinds.nameOf(1), QStringLiteral("Stands"));
        QCOMPARE(kinds.rowAt(0), std::optional(0));
        QCOMPARE(kinds.rowAt(TimelineKinds::kRowStep), std::optional(1));
        QCOMPARE(kinds.rowAt(kinds.height()), std::optional<int>());
        QCOMPARE(kinds.rowAt(-1), std::optional<int>());
        QVERIFY(TimelineKinds().empty());
    }

    void barsLieWhereThingsHappen() {
        const TimelineKinds kinds(stopsAndStands());
        const TimelineAxis some = axis(100);  // 5 px a frame
        const auto stops = kinds.bars(0, some);
        QCOMPARE(stops, (std::vector<TimelineKinds::Bar>{{150, 160}, {500, 505}}));
        QCOMPARE(kinds.bars(1, some), (std::vector<TimelineKinds::Bar>{{150, 355}}));
        TimelineAxis near = axis(100);
        near.showFrames(20, 29);  // inside of the stand
        QCOMPARE(kinds.bars(1, near), (std::vector<TimelineKinds::Bar>{{100, 600}}));
        QVERIFY(kinds.bars(0, near).empty());
    }

    void tenThousandAreNoMoreBarsThanColumns() {
        TimelineKind many = kind(QStringLiteral("Stops"), {});
        for (int i = 0; i < 10'000; ++i) many.happenings.push_back({i + 1, 9 * i, 9 * i + 1});
        const TimelineKinds kinds({many});
        TimelineAxis whole = axis(90'000);
        const auto bars = kinds.bars(0, whole);
        QVERIFY(bars.size() <= 501);
        for (std::size_t i = 1; i < bars.size(); ++i) QVERIFY(bars[i - 1].second < bars[i].first);
        whole.zoomAround(350, 1000);
        QVERIFY(kinds.bars(0, whole).size() <= 20);
    }

    void theMostFrequentOfManyKindsShareTheLastRow() {
        std::vector<TimelineKind> many;
        for (int i = 0; i < 12; ++i) many.push_back(severalOf(QStringLiteral("kind %1").arg(i), 20 - i));
        const TimelineKinds kinds(many);
        QCOMPARE(kinds.rowCount(), TimelineKinds::kMostRows);
        QCOMPARE(kinds.nameOf(0), QStringLiteral("kind 5"));
        QCOMPARE(kinds.nameOf(6), QStringLiteral("kind 11"));
        QCOMPARE(kinds.nameOf(7), QStringLiteral("5 other kinds"));
        const TimelineAxis some = axis(100);
        QVERIFY(kinds.textAt(7, some.centreOf(0), some, 1).contains(QStringLiteral("kind 4: 1 here, 16 in all")));
        QVERIFY(kinds.textAt(7, some.centreOf(90), some, 1).contains(QStringLiteral("kind 0, kind 1")));
        for (TimelineKind& each : many) each.happenings.resize(3);
        QCOMPARE(TimelineKinds(many).nameOf(0), QStringLiteral("kind 0"));  // as many of each
        QCOMPARE(TimelineKinds(many).rowCount(), TimelineKinds::kMostRows);
    }

    void aRowHasTheColourOfItsKindOnBothGroundsAndItsShape() {
        std::vector<TimelineKind> two = stopsAndStands();
        two[0].shape = BarShape::edges;
        const TimelineKinds kinds(two);
        QPalette light;
        light.setColor(QPalette::Window, Qt::white);
        light.setColor(QPalette::Base, Qt::white);
        light.setColor(QPalette::WindowText, Qt::black);
        QPalette dark;
        dark.setColor(QPalette::Window, Qt::black);
        dark.setColor(QPalette::Base, Qt::black);
        dark.setColor(QPalette::WindowText, Qt::white);
        QCOMPARE(kinds.colourOf(0, light), QColor(0, 60, 120));
        QCOMPARE(kinds.colourOf(0, dark), QColor(120, 200, 255));
        QCOMPARE(kinds.shapeOf(0), BarShape::edges);
        QCOMPARE(kinds.shapeOf(1), BarShape::full_height);
        const QRectF bar(10, 20, 30, 4);
        QCOMPARE(filledParts(BarShape::full_height, bar), (std::vector<QRectF>{bar}));
        QCOMPARE(filledParts(BarShape::upper_half, bar), (std::vector<QRectF>{{10, 20, 30, 2}}));
        QCOMPARE(filledParts(BarShape::lower_half, bar), (std::vector<QRectF>{{10, 22, 30, 2}}));
        QCOMPARE(filledParts(BarShape::edges, bar), (std::vector<QRectF>{{10, 20, 30, 1}, {10, 23, 30, 1}}));
    }

    void aPlaceTellsKindAndCountAndTheNearest() {
        const TimelineKinds kinds(stopsAndStands());
        const TimelineAxis some = axis(100);
        QCOMPARE(kinds.textAt(0, 155, some, 5), QStringLiteral("Stops: 2 here, 3 in all"));
        QCOMPARE(kinds.textAt(0, 300, some, 5), QStringLiteral("Stops: 0 here, 3 in all"));
        QCOMPARE(kinds.nearest(0, 152, some, 5), std::optional(1));
        QCOMPARE(kinds.nearest(0, 158, some, 5), std::optional(2));
        QCOMPARE(kinds.nearest(0, 300, some, 5), std::optional<int>());
        QCOMPARE(kinds.nearest(1, 300, some, 5), std::optional(4));
    }

    void aClickOnARowLeadsToWhatHappenedThere() {
        const auto view = viewOf(stopsAndStands());
        QSignalSpy clicked(view.get(), &TimelineView::markClicked);
        QSignalSpy scrubbed(view.get(), &TimelineView::frameRequested);
        const auto place = view->placeInKinds(3);
        QVERIFY(place);
        QTest::mouseClick(view.get(), Qt::LeftButton, {}, place->toPoint());
        QCOMPARE(clicked.count(), 1);
        QCOMPARE(clicked.front().front().toInt(), 3);
        QCOMPARE(scrubbed.count(), 0);
        QTest::mouseClick(view.get(), Qt::LeftButton, {}, place->toPoint() + QPoint(60, 0));
        QCOMPARE(clicked.count(), 1);
        QVERIFY(scrubbed.count() > 0);
        QHelpEvent help(QEvent::ToolTip, place->toPoint(), view->mapToGlobal(place->toPoint()));
        QApplication::sendEvent(view.get(), &help);
        QCOMPARE(QToolTip::text(), QStringLiteral("Stops: 1 here, 3 in all"));
        QToolTip::hideText();
    }

    void theRowsAreFoldedAndTakeNoRoomThen() {
        const auto plain = viewOf({});
        const auto view = viewOf(stopsAndStands());
        const int height = view->sizeHint().height();
        QVERIFY(height > plain->sizeHint().height());
        QVERIFY2(height <= plain->sizeHint().height() + 14, "two thin rows");
        QSignalSpy wanted(view.get(), &TimelineView::kindsShownWanted);
        const QPoint gutter(20, static_cast<int>(view->placeOfMark(1)->y()));
        QTest::mouseClick(view.get(), Qt::LeftButton, {}, gutter);
        QCOMPARE(wanted.count(), 1);
        QCOMPARE(wanted.front().front().toBool(), false);
        view->setKindsShown(false);
        QCOMPARE(view->sizeHint().height(), plain->sizeHint().height());
        QVERIFY(!view->placeInKinds(3));
        QTest::mouseClick(view.get(), Qt::LeftButton, {}, gutter);
        QCOMPARE(wanted.back().front().toBool(), true);
        view->setKindsShown(true);
        QCOMPARE(view->sizeHint().height(), height);
        wanted.clear();
        view->showAround(10, 20, 0);
        const double zoomed = view->axis().pixelsPerFrame();
        QTest::mouseClick(view.get(), Qt::LeftButton, {}, gutter);
        QTest::mouseDClick(view.get(), Qt::LeftButton, {}, gutter);
        QVERIFY2(wanted.count() >= 2, "each click counts");
        QCOMPARE(view->axis().pixelsPerFrame(), zoomed);
        view->setTimes({0, 40'000});
        QVERIFY2(view->kinds().empty(), "of another video");
    }

    void allOfThemFitBelowTheVideoOfASmallScreen() {
        std::vector<TimelineKind> many;
        for (int i = 0; i < 18; ++i) many.push_back(severalOf(QStringLiteral("kind %1").arg(i), i + 1));
        const auto view = viewOf(many);
        view->setWatched(std::vector<FrameSpan>{{0, 3}});
        QVERIFY2(view->sizeHint().height() <= 190, qPrintable(QString::number(view->sizeHint().height())));
        view->grab();
    }
};

}  // namespace eyrie::ui::timeline_kinds_test

EYRIE_UI_TEST(QApplication, timeline_kinds_test, TimelineKindsTest)
#include "timeline_kinds_test.moc"
