#include <QClipboard>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <limits>

#include "panels_support.h"
#include "ui/support/ui_test.h"
#include "widgets/charts/stage_times_chart.h"
#include "widgets/charts/stage_times_data.h"
#include "widgets/theme_colours.h"

namespace eyrie::ui::panels_stage_times_test {

namespace {

FrameSummary frameWith(FrameIndex frame, std::initializer_list<std::pair<Stage, float>> times) {
    FrameSummary summary;
    summary.frame = frame;
    for (const auto& [stage, ms] : times) summary.stage_ms[static_cast<std::size_t>(stage)] = ms;
    return summary;
}

std::vector<FrameSummary> wholeRun(int frames) {
    std::vector<FrameSummary> run;
    for (int i = 0; i < frames; ++i) {
        const float wave = static_cast<float>(1 + std::sin(i * 0.05));
        run.push_back(frameWith(i, {{Stage::read, 1.5F},
                                    {Stage::corners, 1 + wave},
                                    {Stage::tracking_corners, 2 + 2 * wave},
                                    {Stage::homography, 0.3F},
                                    {Stage::clustering, 0.5F},
                                    {Stage::detection, i == 0 ? 300.F : 3 * wave},
                                    {Stage::tracking, 0.8F},
                                    {Stage::store, 1.F}}));
    }
    return run;
}

/// Waits until what the chart was given is in its picture.
bool isDrawn(const StageTimesChart& chart) {
    const bool refreshed = QTest::qWaitFor([&] { return !chart.refreshDue(); });
    QCoreApplication::processEvents();  // the plot draws when the event loop is free
    return refreshed;
}

}  // namespace

class StageTimesTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { QLocale::setDefault(QLocale::c()); }

    void bandsLieOnEachOther() {
        StageTimesData data;
        data.append(frameWith(3, {{Stage::read, 2}, {Stage::motion, 4}, {Stage::store, 1}}));
        QCOMPARE(data.topsAt(0)[0], 2.0);
        QCOMPARE(data.topsAt(0)[1], 2.0);
        QCOMPARE(data.topsAt(0)[4], 6.0);
        QCOMPARE(data.totalAt(0), 7.0);
        QCOMPARE(data.stageAt(0, Stage::read), 2.0);
        QCOMPARE(data.stageAt(0, Stage::motion), 4.0);
        QCOMPARE(data.stageAt(0, Stage::corners), 0.0);
        QVERIFY(data.isUsed(Stage::store));
        QVERIFY(!data.isUsed(Stage::detection));
    }

    void oddTimesAreNoTimes() {
        StageTimesData data;
        data.append(frameWith(0, {{Stage::read, std::numeric_limits<float>::quiet_NaN()},
                                  {Stage::motion, -1},
                                  {Stage::store, std::numeric_limits<float>::infinity()}}));
        QCOMPARE(data.totalAt(0), 0.0);
        data.append(frameWith(0, {{Stage::read, 5}}));
        QCOMPARE(data.size(), std::size_t{1});
    }

    void oneSlowFrameDoesNotSpoilTheAxis() {
        StageTimesData data;
        for (const FrameSummary& frame : wholeRun(200)) data.append(frame);
        QVERIFY(data.totalAt(0) > 300);
        QVERIFY(data.axisMaximum() < 30);
        QVERIFY(data.axisMaximum() > data.totalAt(31));
        QCOMPARE(StageTimesData().axisMaximum(), 1.0);
        QVERIFY(std::abs(data.median(Stage::tracking) - 0.8) < 1e-6);
    }

    void framesAreFoundByTheirNumber() {
        StageTimesData data;
        for (const int frame : {10, 12, 20}) data.append(frameWith(frame, {{Stage::read, 1}}));
        QVERIFY(!data.positionOf(9).has_value());
        QCOMPARE(*data.positionOf(10), std::size_t{0});
        QCOMPARE(*data.positionOf(15), std::size_t{1});
        QCOMPARE(*data.positionOf(999), std::size_t{2});
    }

    void aFrameIsDescribedByItsDearestStages() {
        StageTimesData data;
        data.append(frameWith(12, {{Stage::read, 2}, {Stage::detection, 9.5F}, {Stage::store, 0.25F}}));
        QCOMPARE(data.describe(0), QStringLiteral("frame 12: 11.8 ms · detection 9.50 · read 2.00 · store 0.25"));
        QCOMPARE(data.text(), QStringLiteral("frame\tread (ms)\tdetection (ms)\tstore (ms)\tsum (ms)\n"
                                             "12\t2.000\t9.500\t0.250\t11.750\n"));
    }

    void theChartTakesFramesAsTheyCome() {
        StageTimesChart chart;
        chart.resize(600, 300);
        chart.show();
        const auto run = wholeRun(300);
        chart.setFrames({run.begin(), run.begin() + 100});
        chart.append(run[100]);
        chart.setFrames(run);
        QCOMPARE(chart.data().size(), std::size_t{300});
        QCOMPARE(chart.data().frameAt(299), 299);
        chart.setCurrentFrame(120);
        chart.setBudgetMs(40);
        const auto other = wholeRun(50);
        chart.setFrames({other.begin() + 10, other.end()});
        QCOMPARE(chart.data().size(), std::size_t{40});
        chart.setFrames({});
        QCOMPARE(chart.data().size(), std::size_t{0});
        QVERIFY(isDrawn(chart));
    }

    void aClickGoesToTheFrame() {
        StageTimesChart chart;
        chart.resize(600, 300);
        chart.setFrames(wholeRun(200));
        chart.show();
        QVERIFY(QTest::qWaitForWindowExposed(&chart));
        QVERIFY(isDrawn(chart));
        QSignalSpy activated(&chart, &StageTimesChart::frameActivated);
        auto* plot = chart.findChild<QWidget*>(QStringLiteral("plot"));
        QVERIFY(plot != nullptr);
        QTest::mouseClick(plot, Qt::LeftButton, Qt::NoModifier, QPoint(plot->width() / 2, plot->height() / 2));
        QCOMPARE(activated.count(), 1);
        const int frame = activated[0][0].toInt();
        QVERIFY(frame > 20 && frame < 180);
        QTest::mousePress(plot, Qt::LeftButton, Qt::NoModifier, QPoint(200, 100));
        QTest::mouseRelease(plot, Qt::LeftButton, Qt::NoModifier, QPoint(300, 100));
        QCOMPARE(activated.count(), 1);
    }

    void longRunsAreDrawnInBins() {
        StageTimesData data;
        QVERIFY(data.bins(0, 10, 5).empty());
        for (int frame = 0; frame < 1000; ++frame) {
            data.append(frameWith(frame, {{Stage::read, 1}, {Stage::store, frame == 500 ? 50.F : 2.F}}));
        }
        const auto all = data.bins(0, 999, 100);
        QVERIFY(all.size() <= 101);
        QCOMPARE(all[0].frame, 4.5);
        QCOMPARE(all[0].tops.front(), 1.0);
        QVERIFY(std::abs(all[0].tops.back() - 3) < 1e-9);
        QVERIFY(std::abs(all[50].tops.back() - 7.8) < 1e-9);  // nine times 3 and once 51, of ten
        QCOMPARE(all[50].peak, 51.0);
        const auto few = data.bins(100, 109, 100);
        QCOMPARE(few.size(), std::size_t{12});
        QCOMPARE(few[0].frame, 99.0);
        QCOMPARE(few.back().frame, 110.0);
        QCOMPARE(data.bins(0, 999, 0).size(), std::size_t{1});
        QVERIFY(data.bins(5000, 6000, 100).size() <= 2);
        QVERIFY(data.bins(-50, -20, 100).size() <= 2);
    }

    void draggingStaysWhereItWasLeft() {
        StageTimesChart chart;
        chart.resize(600, 300);
        chart.setFrames(wholeRun(200));
        chart.show();
        QVERIFY(QTest::qWaitForWindowExposed(&chart));
        auto* plot = chart.findChild<QWidget*>(QStringLiteral("plot"));
        QVERIFY(isDrawn(chart));
        QSignalSpy activated(&chart, &StageTimesChart::frameActivated);
        const QPoint place(plot->width() / 2, plot->height() / 2);
        QTest::mouseClick(plot, Qt::LeftButton, Qt::NoModifier, place);
        QTest::mousePress(plot, Qt::LeftButton, Qt::NoModifier, place);
        // QTest::mouseMove() tells of no pressed buttons.
        for (const int way : {20, 60}) {
            const QPointF to = place + QPoint(way, 0);
            QMouseEvent move(QEvent::MouseMove, to, plot->mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                             Qt::NoModifier);
            QApplication::sendEvent(plot, &move);
        }
        QTest::mouseRelease(plot, Qt::LeftButton, Qt::NoModifier, place + QPoint(60, 0));
        QVERIFY(isDrawn(chart));
        QCOMPARE(activated.count(), 1);
        QTest::mouseClick(plot, Qt::LeftButton, Qt::NoModifier, place);
        QVERIFY(activated[1][0].toInt() < activated[0][0].toInt());
    }

    void copiesAsText() {
        StageTimesChart chart;
        chart.setFrames(wholeRun(3));
        chart.show();
        QTest::keyClick(&chart, Qt::Key_C, Qt::ControlModifier);
        QCOMPARE(QApplication::clipboard()->text().count(QLatin1Char('\n')), 4);
        QVERIFY(!chart.picture().isNull());
    }

    void looksRightInBothThemes() {
        for (const bool dark : {false, true}) {
            StageTimesChart chart;
            if (dark) chart.setPalette(ui::test::darkPalette());
            chart.resize(720, 300);
            chart.setFrames(wholeRun(400));
            chart.setBudgetMs(15);
            chart.setCurrentFrame(200);
            chart.show();
            QVERIFY(QTest::qWaitForWindowExposed(&chart));
            QVERIFY(isDrawn(chart));
            ui::test::keepPicture(chart, dark ? QStringLiteral("times_dark") : QStringLiteral("times_light"));
            for (int stage = 0; stage < kStageCount; ++stage) {
                const QPalette palette = chart.palette();
                const QColor colour = stageColour(static_cast<Stage>(stage), palette);
                QVERIFY2(ui::test::contrast(colour, palette.color(QPalette::Base)) > 1.8,
                         nameOf(static_cast<Stage>(stage)));
            }
            QVERIFY(ui::test::contrast(quietText(chart.palette()), chart.palette().color(QPalette::Window)) > 4.5);
        }
    }
};

}  // namespace eyrie::ui::panels_stage_times_test

EYRIE_UI_TEST(QApplication, panels_stage_times_test, StageTimesTest)
#include "panels_stage_times_test.moc"
