#include <QClipboard>
#include <QHeaderView>
#include <QHelpEvent>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QScrollBar>
#include <QSignalSpy>
#include <QSlider>
#include <QStandardItemModel>
#include <QTableView>
#include <QTest>
#include <QTimer>
#include <QToolTip>
#include <algorithm>
#include <memory>

#include "panels_support.h"
#include "review/runs/runs_panel.h"
#include "review/tracks/tracks_panel.h"
#include "ui/support/ui_test.h"
#include "widgets/empty_state.h"
#include "widgets/tables/table_roles.h"
#include "widgets/tables/table_sort_proxy.h"

namespace eyrie::ui::panels_tables_test {

using eyrie::ui::test::sampleRun;
using eyrie::ui::test::sampleTrack;
using eyrie::ui::test::several;

class TablesTest : public QObject {
    Q_OBJECT

    std::unique_ptr<ui::test::OwnSettings> settings_;

    static void clickRow(const TablePanel& panel, int row, int column = 0) {
        const QTableView* table = panel.table();
        QTest::mouseClick(table->viewport(), Qt::LeftButton, Qt::NoModifier,
                          table->visualRect(table->model()->index(row, column)).center());
    }

 private slots:
    void init() {
        QLocale::setDefault(QLocale::c());
        settings_ = std::make_unique<ui::test::OwnSettings>();
    }

    void emptyListsTeach() {
        RunsModel model;
        RunsPanel panel(&model);
        panel.show();
        QVERIFY(panel.emptyState()->isVisible());
        QVERIFY(!panel.emptyState()->explanation().isEmpty());
        int run = 0;
        panel.setCommands({.run = [&] { ++run; }});
        panel.emptyState()->findChild<QPushButton*>()->click();
        QCOMPARE(run, 1);
        model.setRuns({sampleRun(1)});
        QVERIFY(!panel.emptyState()->isVisible());
        QVERIFY(panel.table()->isVisible());
        panel.setFilterText(QStringLiteral("nowhere"));
        QVERIFY(!panel.table()->isVisible());
        QVERIFY(!panel.emptyState()->isVisible());
        panel.setFilterText(QString());
        QVERIFY(panel.table()->isVisible());
    }

    void aNumberFindsThatNumberAndTextAnyPart() {
        QStandardItemModel model(0, 2);
        const auto add = [&](const QString& text, double number, const QString& note) {
            auto* cell = new QStandardItem(text);
            cell->setData(number, sort_role);
            auto* words = new QStandardItem(note);
            words->setData(note, sort_role);
            model.appendRow({cell, words});
        };
        add(QStringLiteral("5"), 5, QStringLiteral("north"));
        add(QStringLiteral("15"), 15, QStringLiteral("gate 51"));
        add(QStringLiteral("51"), 51, QStringLiteral("south"));
        add(QStringLiteral("5.00 km/h"), 5, QStringLiteral("south"));
        add(QStringLiteral("3, 5"), 3, QStringLiteral("south"));
        add(QStringLiteral("1,005"), 1005, QStringLiteral("south"));
        add(QStringLiteral("22:08:24"), 7000, QStringLiteral("south"));
        TableSortProxy proxy;
        proxy.setSourceModel(&model);
        const auto found = [&](const char* text) {
            proxy.setFilterText(QString::fromUtf8(text));
            QStringList rows;
            for (int row = 0; row < proxy.rowCount(); ++row) rows << proxy.index(row, 0).data().toString();
            return rows.join(QStringLiteral(" | "));
        };
        QCOMPARE(found("5"), QStringLiteral("5 | 15 | 5.00 km/h | 3, 5"));  // 15 by its note, which is text
        QCOMPARE(found("15"), QStringLiteral("15"));
        QCOMPARE(found("1005"), QStringLiteral("1,005"));
        QCOMPARE(found("5.0"), QStringLiteral("5.00 km/h"));
        QCOMPARE(found("22"), QStringLiteral("22:08:24"));  // a time is found as one types it
        QCOMPARE(found("gat 15"), QStringLiteral("15"));
        QCOMPARE(found("outh 5"), QStringLiteral("5.00 km/h | 3, 5"));
    }

    void ctrlAddsARowAlthoughTheRowIsSelectedElsewhereToo() {
        TracksModel model;
        TracksPanel panel(&model);
        model.setTracks(several(5, sampleTrack), {});
        panel.resize(700, 300);
        panel.show();
        panel.setCommands({.select = [&](int track) { panel.selectId(track); }});
        clickRow(panel, 0);
        const QRect row = panel.table()->visualRect(panel.table()->model()->index(1, 0));
        QTest::mouseClick(panel.table()->viewport(), Qt::LeftButton, Qt::ControlModifier, row.center());
        QCOMPARE(panel.selectedIds(), (QList<int>{1, 2}));
    }

    void aClickOnAWideCellLeavesTheColumnsWhereTheyAre() {
        TracksModel model;
        TracksPanel panel(&model);
        model.setTracks(several(5, sampleTrack), {});
        panel.resize(300, 300);
        panel.show();
        QTableView& table = *panel.table();
        table.setColumnWidth(TracksModel::first_column, 600);
        QScrollBar& sideways = *table.horizontalScrollBar();
        QCOMPARE(sideways.value(), 0);
        table.setFocus();
        const QModelIndex wide = table.model()->index(1, TracksModel::first_column);
        QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, table.visualRect(wide).topLeft() + QPoint(5, 5));
        QTest::qWait(QApplication::doubleClickInterval() + 200);  // views go there only when it is no double click
        QCOMPARE(sideways.value(), 0);
        QCOMPARE(table.currentIndex().column(), static_cast<int>(TracksModel::first_column));
        QTest::keyClick(&table, Qt::Key_Down);
        QCOMPARE(sideways.value(), 0);
        QTest::keyClick(&table, Qt::Key_Right);
        const int place = sideways.value();
        QVERIFY2(place > 0, "who goes to another column by keys sees it");
        panel.selectId(1);
        QCOMPARE(sideways.value(), place);
    }

    void aColumnThatWasShownStaysSoEvenIfTheModelGoesFirst() {
        {
            auto model = std::make_unique<TracksModel>();
            TracksPanel panel(model.get());
            QVERIFY(panel.table()->isColumnHidden(TracksModel::picture_column));
            panel.table()->setColumnHidden(TracksModel::picture_column, false);
            model->setTracks(several(3, sampleTrack), {});
            model.reset();  // as when a signal ends the program
        }
        TracksModel model;
        const TracksPanel panel(&model);
        QVERIFY(!panel.table()->isColumnHidden(TracksModel::picture_column));
    }

    void choosingARunTellsIt() {
        RunsModel model;
        RunsPanel panel(&model);
        model.setRuns(several(3, sampleRun));
        panel.show();
        std::vector<int> shown;
        std::vector<int> removed;
        panel.setCommands(
            {.show = [&](int run) { shown.push_back(run); }, .remove = [&](int run) { removed.push_back(run); }});
        clickRow(panel, 1);
        QCOMPARE(shown, std::vector<int>{2});
        panel.selectId(3);
        QCOMPARE(panel.currentId(), 3);
        QCOMPARE(shown, std::vector<int>{2});
        QTest::keyClick(panel.table(), Qt::Key_Delete);
        QCOMPARE(removed, std::vector<int>{3});
    }

    void enterInTheFilterLineGoesToTheFirstRowThatIsLeft() {
        TracksModel model;
        TracksPanel panel(&model);
        model.setTracks(several(5, sampleTrack), {});
        panel.show();
        std::vector<int> selected;
        panel.setCommands({.select = [&](int track) { selected.push_back(track); }});
        auto* filter = panel.findChild<QLineEdit*>();
        filter->setFocus();
        QTest::keyClicks(filter, QStringLiteral("5"));
        QVERIFY(selected.empty());
        QTest::keyClick(filter, Qt::Key_Return);
        QCOMPARE(selected, std::vector<int>{5});
        QCOMPARE(panel.currentId(), 5);
        QCOMPARE(panel.focusWidget(), panel.table());  // letters judge again, and are not typed
        // What is selected stays so.
        filter->clear();
        filter->setFocus();
        QTest::keyClick(filter, Qt::Key_Down);
        QCOMPARE(panel.currentId(), 5);
        QCOMPARE(selected.size(), std::size_t(1));
        QCOMPARE(panel.focusWidget(), panel.table());
        // With nothing to go to one goes on writing.
        panel.setFilterText(QStringLiteral("nowhere"));
        filter->setFocus();
        QTest::keyClick(filter, Qt::Key_Return);
        QCOMPARE(panel.focusWidget(), filter);
    }

    void clickingATrackGoesToIt() {
        TracksModel model;
        TracksPanel panel(&model);
        model.setTracks(several(5, sampleTrack), {});
        panel.resize(700, 300);
        panel.show();
        QCOMPARE(panel.table()->model()->rowCount(), 4);  // the third is tentative
        int selected = 0;
        std::vector<std::pair<int, int>> visits;  // track and frame
        panel.setCommands({.select = [&](int) { ++selected; },
                           .go_to = [&](int track, int frame) { visits.emplace_back(track, frame); }});
        clickRow(panel, 1);
        QCOMPARE(selected, 1);
        QCOMPARE(visits, (std::vector<std::pair<int, int>>{{2, 20}}));
        clickRow(panel, 1, TracksModel::last_column);
        QCOMPARE(selected, 1);
        QCOMPARE(visits.back().second, 69);
        QTest::keyClick(panel.table(), Qt::Key_Return);
        QCOMPARE(visits.size(), std::size_t(3));
        panel.setTentativeShown(true);
        QCOMPARE(panel.table()->model()->rowCount(), 5);
    }

    void sensitivityHidesUnsureTracks() {
        TracksModel model;
        TracksPanel panel(&model);
        std::vector<TrackSummary> tracks;
        for (const double score : {0.3, 0.62, 0.97}) {
            tracks.push_back(sampleTrack(static_cast<int>(tracks.size()) + 1));
            tracks.back().confirmed = true;
            tracks.back().score = score;
        }
        model.setTracks(tracks, {});
        panel.show();
        QCOMPARE(panel.countText(), QStringLiteral("3 of 3 tracks"));
        QCOMPARE(model.index(1, TracksModel::score_column).data().toString(), QStringLiteral("0.62"));
        double min_score = -1;
        panel.setCommands({.use_min_score = [&](double score) { min_score = score; }});
        panel.sensitivity()->setValue(40);
        QCOMPARE(panel.table()->model()->rowCount(), 2);
        QCOMPARE(panel.countText(), QStringLiteral("2 of 3 tracks"));
        QCOMPARE(min_score, 0.6);
        panel.sensitivity()->setFocus();
        QTest::keyClick(panel.sensitivity(), Qt::Key_Home);
        QCOMPARE(panel.table()->model()->rowCount(), 0);
        QTest::keyClick(panel.sensitivity(), Qt::Key_End);
        QCOMPARE(panel.table()->model()->rowCount(), 3);
        QCOMPARE(min_score, 0.0);
        // Those of another run, too.
        panel.sensitivity()->setValue(10);
        tracks[0].score = 0.95;
        model.setTracks(tracks, {});
        QCOMPARE(panel.countText(), QStringLiteral("2 of 3 tracks"));
    }

    void whatARunLeftOutForItsScoreIsASlideAway() {
        TracksModel model;
        TracksPanel panel(&model);
        std::vector<TrackSummary> tracks{sampleTrack(1), sampleTrack(2)};
        for (TrackSummary& track : tracks) track.confirmed = true;
        tracks[0].score = 0.9;
        tracks[1].score = 0.12;
        tracks[1].doubtful = true;
        double min_score = -1;
        panel.setCommands({.use_min_score = [&](double score) { min_score = score; }});
        panel.setThreshold(0.2);
        model.setTracks(tracks, {});
        QCOMPARE(panel.sensitivity()->value(), 80);
        QVERIFY(std::abs(min_score - 0.2) < 1e-9);
        QCOMPARE(panel.countText(), QStringLiteral("1 of 1 track"));
        panel.sensitivity()->setValue(90);
        QCOMPARE(panel.table()->model()->rowCount(), 2);
        QCOMPARE(panel.countText(), QStringLiteral("2 of 2 tracks"));
        QCOMPARE(model.index(1, TracksModel::status_column).data().toString(), QStringLiteral("left out"));
        panel.setThreshold(0.3);
        QCOMPARE(panel.sensitivity()->value(), 90);  // somebody moved it
        panel.sensitivity()->setValue(70);
        panel.setThreshold(0);
        QCOMPARE(panel.sensitivity()->value(), 100);
    }

    void whatARunLeftOutHasNoRowsUntilItIsAskedFor() {
        constexpr int kTracks = 20'000;
        TracksModel model;
        TracksPanel panel(&model);
        panel.setThreshold(0.5);
        std::vector<TrackSummary> tracks = several(kTracks, sampleTrack);
        for (std::size_t i = 0; i < tracks.size(); ++i) {
            tracks[i].confirmed = true;
            tracks[i].doubtful = i % 101 != 0;
            tracks[i].score = tracks[i].doubtful ? static_cast<double>(i * 7919 % 500) / 1000 : 0.9;
        }
        const int result = static_cast<int>(
            std::count_if(tracks.begin(), tracks.end(), [](const TrackSummary& track) { return !track.doubtful; }));
        panel.show();
        QSignalSpy given(&model, &QAbstractItemModel::rowsInserted);
        model.setTracks(tracks, {});
        QCOMPARE(model.rowCount(), result);
        QCOMPARE(given.count(), 1);
        QCOMPARE(panel.countText(), QStringLiteral("%1 of %1 tracks").arg(result));
        const QAbstractItemModel* shown = panel.table()->model();
        // However they lie among each other, they come and go at once.
        QSignalSpy come(shown, &QAbstractItemModel::rowsInserted), gone(shown, &QAbstractItemModel::rowsRemoved);
        panel.selectId(102);
        panel.sensitivity()->setValue(100);
        QCOMPARE(shown->rowCount(), kTracks);
        QCOMPARE(panel.currentId(), 102);
        panel.sensitivity()->setValue(75);
        const auto from_here =
            std::count_if(tracks.begin(), tracks.end(), [](const TrackSummary& track) { return track.score >= 0.25; });
        QCOMPARE(shown->rowCount(), static_cast<int>(from_here));
        panel.sensitivity()->setValue(50);
        QCOMPARE(model.rowCount(), result);
        QVERIFY(come.count() + gone.count() <= 3);
        QCOMPARE(panel.currentId(), 102);
    }

    void rejectedTracksStayListedInGreyAndAreCountedApart() {
        TracksModel model;
        TracksPanel panel(&model);
        std::vector<TrackSummary> tracks{sampleTrack(1), sampleTrack(2), sampleTrack(4)};
        model.setTracks(tracks, {});
        panel.show();
        QCOMPARE(panel.countText(), QStringLiteral("3 of 3 tracks"));
        QVERIFY(!model.index(1, 0).data(Qt::ForegroundRole).isValid());
        tracks[1].corrected = CorrectionKind::reject;
        tracks[1].confirmed = false;
        model.setTracks(tracks, {});
        QCOMPARE(panel.table()->model()->rowCount(), 3);
        QCOMPARE(model.index(1, TracksModel::status_column).data().toString(), QStringLiteral("rejected"));
        QVERIFY(model.index(1, 0).data(Qt::ForegroundRole).isValid());
        QVERIFY(!model.index(0, 0).data(Qt::ForegroundRole).isValid());
        QCOMPARE(panel.countText(), QStringLiteral("2 of 2 tracks, 1 rejected"));
        panel.setFilterText(QStringLiteral("rejected"));
        QCOMPARE(panel.table()->model()->rowCount(), 1);
        QCOMPARE(panel.countText(), QStringLiteral("0 of 2 tracks, 1 rejected"));
    }

    void aTrackIsListedFromTheVeryThresholdOn() {
        TracksModel model;
        TracksPanel panel(&model);
        std::vector<TrackSummary> tracks;
        for (const double score : {0.123, 0.3, 0.7}) {
            tracks.push_back(sampleTrack(static_cast<int>(tracks.size()) + 1));
            tracks.back().confirmed = true;
            tracks.back().score = score;
        }
        model.setTracks(tracks, {});
        double min_score = -1;
        panel.setCommands({.use_min_score = [&](double score) { min_score = score; }});
        panel.sensitivity()->setValue(70);
        QCOMPARE(panel.countText(), QStringLiteral("2 of 3 tracks"));
        panel.sensitivity()->setValue(30);
        QCOMPARE(panel.countText(), QStringLiteral("1 of 3 tracks"));
        // Thresholds of runs are no whole percents: what is in the result is listed, and nothing below it.
        panel.sensitivity()->setValue(100);
        panel.setThreshold(0.123);
        QCOMPARE(min_score, 0.123);
        QCOMPARE(panel.countText(), QStringLiteral("3 of 3 tracks"));
        panel.setThreshold(0.124);
        QCOMPARE(min_score, 0.124);
        QCOMPARE(panel.countText(), QStringLiteral("2 of 3 tracks"));
    }

    void theSelectionSurvivesNewContentsWithoutBeingTold() {
        TracksModel model;
        TracksPanel panel(&model);
        panel.setTentativeShown(true);
        model.setTracks(several(5, sampleTrack), {});
        panel.show();
        panel.selectId(4);
        int selected = 0;
        panel.setCommands({.select = [&](int) { ++selected; }});
        model.setTracks(several(9, sampleTrack), {});
        QCOMPARE(panel.currentId(), 4);
        panel.table()->sortByColumn(TracksModel::id_column, Qt::DescendingOrder);
        QCOMPARE(panel.currentId(), 4);
        panel.setFilterText(QStringLiteral("no such"));
        panel.setFilterText(QString());
        QCOMPARE(panel.currentId(), 4);
        model.setTracks(several(60, sampleTrack), {});
        model.setTracks({sampleTrack(1), sampleTrack(4)}, {});
        QCOMPARE(panel.currentId(), 4);
        model.setTracks({sampleTrack(1), sampleTrack(2)}, {});
        QVERIFY(panel.currentId() != 4);
        QCOMPARE(selected, 0);
        model.setTracks(several(5, sampleTrack), {});
        QCOMPARE(panel.currentId(), 4);
    }

    void rowsCopyAsTheyAreShown() {
        TracksModel model;
        TracksPanel panel(&model);
        model.setTracks(several(2, sampleTrack), {0.25, 25, true});
        panel.show();
        for (int column = 3; column < TracksModel::column_count; ++column) panel.table()->hideColumn(column);
        auto* header = panel.table()->horizontalHeader();
        header->moveSection(0, header->visualIndex(2));
        QCOMPARE(panel.selectedText(), QStringLiteral("First\tLast\tId\n10\t59\t1\n20\t69\t2\n"));
        panel.selectId(2);
        QTest::keyClick(panel.table(), Qt::Key_C, Qt::ControlModifier);
        QCOMPARE(QApplication::clipboard()->text(), QStringLiteral("First\tLast\tId\n20\t69\t2\n"));
    }

    void columnsAndOrderAreInTheMenuOfARowToo() {
        TracksModel model;
        TracksPanel panel(&model);
        model.setTracks(several(2, sampleTrack), {});
        panel.show();
        const auto choose = [&panel](const QString& of_menu, const QString& entry) {
            bool chosen = false;
            QTimer::singleShot(0, &panel, [&] {
                auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
                if (menu == nullptr) return;
                for (const QAction* each : menu->actions()) {
                    if (each->menu() == nullptr || each->text() != of_menu) continue;
                    for (QAction* action : each->menu()->actions()) {
                        if (chosen || action->text() != entry) continue;
                        chosen = true;
                        action->trigger();
                    }
                }
                menu->close();
            });
            emit panel.table()->customContextMenuRequested({});
            return chosen;
        };
        const auto* header = panel.table()->horizontalHeader();
        const int column = TracksModel::first_column;
        const QString title = model.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
        QVERIFY(choose(QStringLiteral("Columns"), title));
        QVERIFY(panel.table()->isColumnHidden(column));
        QVERIFY(choose(QStringLiteral("Columns"), title));
        QVERIFY(!panel.table()->isColumnHidden(column));
        QVERIFY(choose(QStringLiteral("Order by"), title));
        QCOMPARE(header->sortIndicatorSection(), column);
        QCOMPARE(header->sortIndicatorOrder(), Qt::AscendingOrder);
        QVERIFY(choose(QStringLiteral("Order by"), title + QStringLiteral("  ↑")));
        QCOMPARE(header->sortIndicatorOrder(), Qt::DescendingOrder);
        QCOMPARE(panel.table()->model()->index(0, TracksModel::id_column).data().toInt(), 2);
    }

    void columnsAreRemembered() {
        TracksModel model;
        {
            TracksPanel panel(&model);
            panel.table()->hideColumn(TracksModel::width_column);
            panel.table()->setColumnWidth(TracksModel::speed_column, 137);
            panel.table()->sortByColumn(TracksModel::speed_column, Qt::DescendingOrder);
        }
        TracksPanel panel(&model);
        QVERIFY(panel.table()->isColumnHidden(TracksModel::width_column));
        QCOMPARE(panel.table()->columnWidth(TracksModel::speed_column), 137);
        QCOMPARE(panel.table()->horizontalHeader()->sortIndicatorSection(), int(TracksModel::speed_column));
        model.setTracks(several(2, sampleTrack), {});
        QCOMPARE(panel.table()->model()->index(0, 0).data().toInt(), 2);
    }

    void columnsGrowWithWhatTheyHoldUnlessSomebodyChoseTheirWidth() {
        TracksModel model;
        TracksPanel panel(&model);
        panel.resize(900, 240);
        panel.show();
        std::vector<TrackSummary> tracks = several(2, sampleTrack);
        model.setTracks(tracks, {});
        QTableView& table = *panel.table();
        table.setColumnWidth(TracksModel::first_column, table.columnWidth(TracksModel::first_column) + 2);
        const int chosen = table.columnWidth(TracksModel::first_column);
        const int narrow = table.columnWidth(TracksModel::last_column);
        tracks[1].first_frame = 1'000'000'000;
        tracks[1].last_frame = 2'000'000'000;
        model.setTracks(tracks, {});
        QTRY_VERIFY(table.columnWidth(TracksModel::last_column) > narrow);
        QCOMPARE(table.columnWidth(TracksModel::first_column), chosen);

        // What a narrow cell cannot show, its tooltip does.
        const QRect cell = table.visualRect(table.model()->index(1, TracksModel::first_column));
        QHelpEvent help(QEvent::ToolTip, cell.center(), table.viewport()->mapToGlobal(cell.center()));
        QApplication::sendEvent(table.viewport(), &help);
        QVERIFY(QToolTip::text().startsWith(QStringLiteral("1000000000\n")));
        QToolTip::hideText();
    }

    void aColumnOfShortNumbersGrowsToo() {
        // Headers allow no column as narrow as a short number; that is nobody's choice of a width.
        QStandardItemModel model(0, 2);
        model.setHorizontalHeaderLabels({QStringLiteral("#"), QStringLiteral("Kind")});
        TablePanel panel(&model, QStringLiteral("short_numbers"));
        QTableView& table = *panel.table();
        table.horizontalHeader()->setMinimumSectionSize(60);
        panel.resize(400, 240);
        panel.show();
        const auto add = [&](const QString& number) {
            model.appendRow({new QStandardItem(number), new QStandardItem(QStringLiteral("lost"))});
        };
        add(QStringLiteral("1"));
        QCOMPARE(table.columnWidth(0), 60);
        add(QStringLiteral("123456789012345"));
        QTRY_VERIFY(table.columnWidth(0) > 60);
    }

    void titlesExplainTheirColumns() {
        TracksModel model;
        model.setTracks({}, {0.25, 25, true});
        const auto help = [&](int column) {
            return model.headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString();
        };
        QVERIFY(help(TracksModel::speed_column).contains(QStringLiteral("km/h")));
        QVERIFY(help(TracksModel::score_column).contains(QStringLiteral("from 0 to 1")));
    }

    void thousandsOfTracksAreNoTrouble() {
        TracksModel model;
        TracksPanel panel(&model);
        panel.show();
        for (int count = 1000; count <= 5000; count += 1000) model.setTracks(several(count, sampleTrack), {});
        panel.selectId(4000);
        QCOMPARE(panel.currentId(), 4000);
        // Rows lie elsewhere once the list is another or in another order.
        panel.table()->sortByColumn(TracksModel::id_column, Qt::DescendingOrder);
        panel.selectId(17);
        QCOMPARE(panel.currentId(), 17);
        model.setTracks(several(20, sampleTrack), {});
        panel.selectId(4000);
        QCOMPARE(panel.currentId(), 0);
        panel.selectId(20);
        QCOMPARE(panel.currentId(), 20);
        panel.setFilterText(QStringLiteral("no such track"));
        panel.selectId(19);
        QCOMPARE(panel.currentId(), 0);
        panel.setFilterText(QString());
        QCOMPARE(panel.currentId(), 19);
    }

    void looksRightInBothThemes() {
        for (const bool dark : {false, true}) {
            RunsModel runs;
            RunsPanel panel(&runs);
            if (dark) panel.setPalette(ui::test::darkPalette());
            runs.setRuns(several(6, sampleRun));
            panel.resize(640, 240);
            panel.show();
            ui::test::keepPicture(panel, dark ? QStringLiteral("runs_dark") : QStringLiteral("runs_light"));
            TracksModel tracks;
            TracksPanel track_panel(&tracks);
            tracks.setTracks(several(8, sampleTrack), {0.25, 25, true});
            if (dark) track_panel.setPalette(ui::test::darkPalette());
            track_panel.resize(560, 240);
            track_panel.show();
            ui::test::keepPicture(track_panel, dark ? QStringLiteral("tracks_dark") : QStringLiteral("tracks_light"));
        }
    }
};

}  // namespace eyrie::ui::panels_tables_test

EYRIE_UI_TEST(QApplication, panels_tables_test, TablesTest)
#include "panels_tables_test.moc"
