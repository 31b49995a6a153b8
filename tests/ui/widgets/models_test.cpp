#include <QAbstractItemModelTester>
#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <limits>

#include "panels_support.h"
#include "review/runs/runs_model.h"
#include "review/tracks/tracks_model.h"
#include "ui/support/ui_test.h"
#include "widgets/display_text.h"
#include "widgets/tables/table_roles.h"
#include "widgets/tables/table_sort_proxy.h"
#include "widgets/tables/table_text.h"

namespace eyrie::ui::models_test {

using eyrie::ui::test::sampleRun;
using eyrie::ui::test::sampleTrack;
using eyrie::ui::test::several;

class ModelsTest : public QObject {
    Q_OBJECT

    static QString cell(const QAbstractItemModel& model, int row, int column) {
        return model.index(row, column).data().toString();
    }
    static constexpr auto kFatal = QAbstractItemModelTester::FailureReportingMode::QtTest;

 private slots:
    void initTestCase() { QLocale::setDefault(QLocale::c()); }

    void runsKeepTheRulesOfModels() {
        RunsModel model;
        TableSortProxy proxy;
        proxy.setSourceModel(&model);
        const QAbstractItemModelTester tester(&model, kFatal);
        const QAbstractItemModelTester proxy_tester(&proxy, kFatal);
        model.setRuns({});
        model.setRuns(several(3, sampleRun));
        proxy.sort(RunsModel::state_column, Qt::DescendingOrder);
        model.setRuns({sampleRun(1), sampleRun(3)});
        model.setRuns({sampleRun(1), sampleRun(3), sampleRun(4)});
        model.updateRun(sampleRun(4));
        model.updateRun(sampleRun(5));
        model.setLiveRun(5);
        model.setRuns(several(40, sampleRun));
        proxy.setFilterText(QStringLiteral("thesis"));
        QCOMPARE(proxy.rowCount(), 20);
        model.setRuns({sampleRun(9)});
        model.setRuns({});
        QCOMPARE(model.rowCount(), 0);
    }

    void tracksAreSortedByWhatIsShownOfThem() {
        SceneScale scale{0.25, 25, true};
        scale.slope = ScaleSlope::ofPicture({200, 150}, 0, 0.01);
        TrackSummary near = sampleTrack(1), far = sampleTrack(2);
        near.place = {100, 140};
        far.place = {100, 10};
        near.mean_speed_px = 10;
        far.mean_speed_px = 6;
        near.mean_length_px = 30;
        far.mean_length_px = 20;
        near.mean_width_px = 12;
        far.mean_width_px = 9;
        TracksModel model;
        model.setTracks({near, far}, scale);
        for (const int column : {TracksModel::speed_column, TracksModel::length_column, TracksModel::width_column}) {
            QVERIFY(cell(model, 0, column).toDouble() < cell(model, 1, column).toDouble());
            QVERIFY(model.index(0, column).data(sort_role).toDouble() <
                    model.index(1, column).data(sort_role).toDouble());
        }
    }

    void tracksTellWhenTheyWereSeenWhereThatIsKnown() {
        TracksModel model;
        model.setTracks({sampleTrack(3)}, {});
        const QString first = cell(model, 0, TracksModel::first_column);
        const auto title = [&](int column) {
            return model.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
        };
        QCOMPARE(first, QString::number(model.recordAt(0)->first_frame));
        ClockOfFrames clock;
        clock.time = [&](FrameIndex frame) { return QStringLiteral("t%1").arg(frame); };
        clock.text = [&](FrameIndex frame) { return QStringLiteral("day t%1").arg(frame); };
        clock.origin = [] { return QStringLiteral("the video's metadata"); };
        model.setClock(clock);
        QCOMPARE(cell(model, 0, TracksModel::first_column), QStringLiteral("t") + first);
        QCOMPARE(title(TracksModel::last_column), QStringLiteral("Last (UTC)"));
        const QModelIndex at = model.index(0, TracksModel::first_column);
        QVERIFY(at.data(Qt::ToolTipRole).toString().contains(QStringLiteral("day t") + first));
        QCOMPARE(at.data(sort_role).toInt(), model.recordAt(0)->first_frame);
    }

    void tracksKeepTheRulesOfModels() {
        TracksModel model;
        TableSortProxy proxy;
        proxy.setSourceModel(&model);
        const QAbstractItemModelTester tester(&model, kFatal);
        const QAbstractItemModelTester proxy_tester(&proxy, kFatal);
        model.setTracks(several(5, sampleTrack), {});
        model.setTracks(several(8, sampleTrack), {0.3, 25, true});
        proxy.sort(TracksModel::speed_column);
        model.setTracks({sampleTrack(2), sampleTrack(7)}, {});
        model.setTracks({sampleTrack(1), sampleTrack(2)}, {});
        QCOMPARE(model.rowCount(), 2);
    }

    void newContentsKeepTheRowsThatStay() {
        TracksModel model;
        model.setTracks(several(3, sampleTrack), {});
        const QPersistentModelIndex second = model.index(1, 0);
        const QSignalSpy resets(&model, &QAbstractItemModel::modelReset);
        model.setTracks(several(5, sampleTrack), {});
        QVERIFY(second.isValid());
        model.setTracks({sampleTrack(2), sampleTrack(3), sampleTrack(5), sampleTrack(6)}, {});
        QVERIFY(second.isValid());
        QCOMPARE(second.row(), 0);
        QCOMPARE(second.data(id_role).toInt(), 2);
        QCOMPARE(resets.count(), 0);
    }

    void runsAreReadable() {
        RunsModel model;
        RunRecord named = sampleRun(2);
        named.name = "with “shadows”";
        RunRecord killed = sampleRun(3);
        killed.state = RunState::running;
        killed.frames_done = 63;
        RunRecord failed = sampleRun(4);
        failed.state = RunState::failed;
        failed.message = "the video ends at frame 12";
        failed.scale.gsd_known = false;
        failed.scale_basis = {ScaleOrigin::assumed};
        model.setRuns({sampleRun(1), named, killed, failed});
        QCOMPARE(cell(model, 0, RunsModel::name_column), QStringLiteral("Run 1"));
        QCOMPARE(cell(model, 1, RunsModel::name_column), QStringLiteral("with “shadows”"));
        QCOMPARE(cell(model, 0, RunsModel::frames_column), QStringLiteral("100"));
        QCOMPARE(cell(model, 2, RunsModel::frames_column), QStringLiteral("63/100"));
        QCOMPARE(cell(model, 0, RunsModel::length_column), QStringLiteral("4.0 s"));
        QCOMPARE(cell(model, 2, RunsModel::state_column), QStringLiteral("stopped"));
        model.setLiveRun(3);
        QCOMPARE(cell(model, 2, RunsModel::state_column), QStringLiteral("running"));
        QCOMPARE(cell(model, 3, RunsModel::state_column), QStringLiteral("failed"));
        QVERIFY(model.index(3, 0).data(Qt::ToolTipRole).toString().contains(QStringLiteral("ends at frame 12")));
        QCOMPARE(cell(model, 0, RunsModel::gsd_column), QStringLiteral("0.250"));
        QCOMPARE(cell(model, 3, RunsModel::gsd_column), QStringLiteral("unknown"));
        QCOMPARE(cell(model, 0, RunsModel::video_column), QStringLiteral("street.mp4"));
        QCOMPARE(model.rowOf(3), 2);
        QCOMPARE(model.rowOf(9), -1);
        QVERIFY(model.recordAt(9) == nullptr);
    }

    void runsTellWhereTheirScaleComesFrom() {
        RunsModel model;
        RunRecord estimated = sampleRun(2);
        estimated.scale = {0.2104, 25, false};
        estimated.scale_basis = {ScaleOrigin::estimated, 1.2, 14};
        RunRecord stated = sampleRun(3);
        stated.scale.gsd_m_per_px = 0.0335;
        stated.scale_basis = {ScaleOrigin::metadata};
        model.setRuns({sampleRun(1), estimated, stated});
        QCOMPARE(cell(model, 1, RunsModel::gsd_column), QStringLiteral("≈ 0.210"));
        QCOMPARE(cell(model, 2, RunsModel::gsd_column), QStringLiteral("0.034"));
        const auto tip = [&](int row) { return model.index(row, 0).data(Qt::ToolTipRole).toString(); };
        QVERIFY(tip(0).contains(QStringLiteral("Scale: 0.25 m/px, as given")));
        QVERIFY(
            tip(1).contains(QStringLiteral("0.21 m/px, estimated from 14 vehicles, right to within a factor of 1.2")));
        QVERIFY(tip(2).contains(QStringLiteral("0.0335 m/px, from the video's metadata")));
    }

    void runsTellHowShadowsFall() {
        RunsModel model;
        RunRecord lit = sampleRun(2);
        LightFinding finding;
        finding.last_frame = 99;
        finding.reach_m = 2;
        finding.vehicles = 6;
        finding.agreement = 0.9;
        lit.light = {finding};
        model.setRuns({sampleRun(1), lit});
        const auto tip = [&](int row) { return model.index(row, 0).data(Qt::ToolTipRole).toString(); };
        QVERIFY2(!tip(0).contains(QStringLiteral("Light")), "nothing is known");
        QVERIFY2(tip(1).contains(QStringLiteral("Light: shadows fall to 0° (to the right) in frame 0, 2.0 m")),
                 qPrintable(tip(1)));
        QVERIFY2(Qt::mightBeRichText(tip(1)), "its lines are broken to fit the screen");
    }

    void aRunIsRenamedInItsRow() {
        RunsModel model;
        model.setRuns({sampleRun(7)});
        QSignalSpy renamed(&model, &RunsModel::renameRequested);
        const QModelIndex name = model.index(0, RunsModel::name_column);
        QVERIFY(model.flags(name) & Qt::ItemIsEditable);
        QVERIFY(!(model.flags(model.index(0, RunsModel::state_column)) & Qt::ItemIsEditable));
        QVERIFY(model.setData(name, QStringLiteral("  mine "), Qt::EditRole));
        QCOMPARE(renamed.count(), 1);
        QCOMPARE(renamed[0][0].toInt(), 7);
        QCOMPARE(renamed[0][1].toString(), QStringLiteral("mine"));
        QCOMPARE(name.data().toString(), QStringLiteral("mine"));
        QVERIFY(!model.setData(name, QStringLiteral("mine"), Qt::EditRole));
        QCOMPARE(renamed.count(), 1);
    }

    // 2 px a frame at 0.25 m/px and 25 Hz are 12.5 m/s, which are 45 km/h.
    void tracksShowMetresOnlyWhenTheGsdIsKnown() {
        TracksModel model;
        model.setTracks({sampleTrack(1)}, {0.25, 25, true});
        QCOMPARE(cell(model, 0, TracksModel::speed_column), QStringLiteral("45.0"));
        QCOMPARE(cell(model, 0, TracksModel::length_column), QStringLiteral("4.5"));
        QCOMPARE(cell(model, 0, TracksModel::width_column), QStringLiteral("2.0"));
        QCOMPARE(cell(model, 0, TracksModel::life_column), QStringLiteral("2.0"));
        QCOMPARE(model.headerData(TracksModel::speed_column, Qt::Horizontal, Qt::DisplayRole).toString(),
                 QStringLiteral("Speed (km/h)"));
        model.setTracks({sampleTrack(1)}, {0.25, 25, false});
        QCOMPARE(cell(model, 0, TracksModel::speed_column), QStringLiteral("2.00"));
        QCOMPARE(cell(model, 0, TracksModel::length_column), QStringLiteral("18.0"));
        QCOMPARE(model.headerData(TracksModel::length_column, Qt::Horizontal, Qt::DisplayRole).toString(),
                 QStringLiteral("Length (px)"));
    }

    void tracksSayTheirClassAndSortByIt() {
        std::vector<TrackSummary> tracks = several(4, sampleTrack);
        tracks[0].track_class = TrackClass::vehicle;
        tracks[1].track_class = TrackClass::person;
        tracks[2].track_class = TrackClass::two_wheeler;
        TracksModel model;
        TableSortProxy proxy;
        proxy.setSourceModel(&model);
        model.setTracks(tracks, {0.25, 25, true});
        QCOMPARE(cell(model, 1, TracksModel::class_column), QStringLiteral("person"));
        QCOMPARE(cell(model, 3, TracksModel::class_column), QStringLiteral("–"));
        QCOMPARE(model.headerData(TracksModel::class_column, Qt::Horizontal, Qt::DisplayRole).toString(),
                 QStringLiteral("Class"));
        proxy.sort(TracksModel::class_column);
        QStringList sorted;
        for (int row = 0; row < 4; ++row) sorted << cell(proxy, row, TracksModel::class_column);
        sorted.removeOne(QStringLiteral("–"));  // its place is that of the user's language
        QCOMPARE(sorted,
                 QStringList({QStringLiteral("person"), QStringLiteral("two-wheeler"), QStringLiteral("vehicle")}));
        proxy.setFilterText(QStringLiteral("two-wheeler"));
        QCOMPARE(proxy.rowCount(), 1);
    }

    void numbersSortAsNumbers() {
        TracksModel model;
        TableSortProxy proxy;
        proxy.setSourceModel(&model);
        model.setTracks({sampleTrack(2), sampleTrack(10), sampleTrack(1)}, {});
        for (const int column :
             {int(TracksModel::id_column), int(TracksModel::first_column), int(TracksModel::speed_column)}) {
            proxy.sort(column);
            QCOMPARE(cell(proxy, 0, 0), QStringLiteral("1"));
            QCOMPARE(cell(proxy, 2, 0), QStringLiteral("10"));
            proxy.sort(column, Qt::DescendingOrder);
            QCOMPARE(cell(proxy, 0, 0), QStringLiteral("10"));
        }
    }

    void everyWordOfTheFilterMustBeThere() {
        TracksModel model;
        TableSortProxy proxy;
        proxy.setSourceModel(&model);
        model.setTracks(several(9, sampleTrack), {});
        proxy.setFilterText(QStringLiteral("tentative"));
        QCOMPARE(proxy.rowCount(), 3);
        proxy.setFilterText(QStringLiteral("  30  TENTATIVE "));
        QCOMPARE(proxy.rowCount(), 1);
        proxy.setFilterText(QString());
        QCOMPARE(proxy.rowCount(), 9);
        proxy.setRowFilter([&](int row) { return model.recordAt(row)->confirmed; });
        QCOMPARE(proxy.rowCount(), 6);
    }

    void whoLooksThroughTheRowsIsToldOnceThatAnotherFilterHolds() {
        TracksModel model;
        TableSortProxy proxy;
        proxy.setSourceModel(&model);
        model.setTracks(several(9, sampleTrack), {});
        const QSignalSpy filtered(&proxy, &TableSortProxy::filtered);
        int steps = 0;
        QObject::connect(&proxy, &QAbstractItemModel::rowsRemoved, &proxy, [&] { steps += proxy.filtering() ? 1 : 0; });
        proxy.setRowFilter([](int row) { return row % 2 == 0; });
        QCOMPARE(proxy.rowCount(), 5);
        QCOMPARE(steps, 4);
        QCOMPARE(filtered.count(), 1);
        QVERIFY(!proxy.filtering());
    }

    void rowsCopyAsText() {
        RunsModel model;
        RunRecord run = sampleRun(1);
        run.name = "a\tb\nc";
        model.setRuns({run, sampleRun(2)});
        QCOMPARE(tableText(model, {0, 1}, {RunsModel::preset_column, RunsModel::name_column}),
                 QStringLiteral("Preset\tRun\ndefault\ta b c\nthesis\tRun 2\n"));
    }

    void durations_data() {
        QTest::addColumn<double>("seconds");
        QTest::addColumn<QString>("text");
        QTest::newRow("none") << 0.0 << "0.0 s";
        QTest::newRow("short") << 4.92 << "4.9 s";
        QTest::newRow("nearly a minute") << 59.97 << "1:00.0";
        QTest::newRow("minutes") << 124.94 << "2:04.9";
        QTest::newRow("nearly an hour") << 3599.99 << "1:00:00";
        QTest::newRow("hours") << 3724.0 << "1:02:04";
        QTest::newRow("no number") << std::numeric_limits<double>::quiet_NaN() << "–";
    }
    void durations() {
        QFETCH(double, seconds);
        QFETCH(QString, text);
        QCOMPARE(durationText(seconds), text);
    }

    void textsOfNumbers() {
        QCOMPARE(speedText(2, {0.25, 25, true}), QStringLiteral("45.0 km/h"));
        QCOMPARE(speedText(2, {0.25, 25, false}), QStringLiteral("2.00 px/frame"));
        QCOMPARE(shortSpeedText(2, {0.25, 25, true}), QStringLiteral("45 km/h"));
        QCOMPARE(shortSpeedText(2, {0.25, 25, false}), QStringLiteral("2.0 px/frame"));
        QCOMPARE(lengthText(10, {0.25, 25, true}), QStringLiteral("2.5 m"));
        QCOMPARE(numberText(std::numeric_limits<double>::infinity(), 1), QStringLiteral("–"));
        QCOMPARE(localTimeText("yesterday"), QStringLiteral("yesterday"));
        QVERIFY(!localTimeText("2026-11-21T08:00:00Z").contains(QLatin1Char('Z')));
        QCOMPARE(projectFilter(), QStringLiteral("Eyrie projects (*.eyrie)"));
    }
};

}  // namespace eyrie::ui::models_test

EYRIE_UI_TEST(QApplication, models_test, ModelsTest)
#include "models_test.moc"
