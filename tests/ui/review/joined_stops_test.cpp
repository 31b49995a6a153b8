#include <QComboBox>
#include <QTableView>
#include <QTest>

#include "review/events/events_panel.h"
#include "ui/review/listed_events.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::joined_stops_test {

using test::found;
using test::happening;

namespace {

/// A vehicle that stops, stands for 40 frames and starts again, and one that turns back.
std::vector<Event> aStop() {
    std::vector<Event> events{happening(EventKind::stops, 1, 10), happening(EventKind::stands, 1, 10),
                              happening(EventKind::starts, 1, 50), happening(EventKind::turns_back, 2, 70)};
    events[1].last_frame = 49;
    events[1].figure = 1.6;
    events[1].unit = FigureUnit::seconds;
    return events;
}

const QString kTurn = QStringLiteral("Turns back");

}  // namespace

/// Three events of one stop are one row, and stay three events.
class JoinedStopsTest : public test::ListedEvents {
    Q_OBJECT

    std::size_t placeOf(const EventsModel& model, EventKind kind) const {
        for (std::size_t place = 0; place < model.found()->queue.size(); ++place)
            if (listedKindAt(*model.found(), place) == static_cast<int>(kind)) return place;
        return 0;
    }

 private slots:
    void init() { begin(); }
    void cleanup() { end(); }

    void aStopIsOneRowAndItsEventsAreCounted() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(aStop()));
        panel.showCounts(0);
        QStringList kinds = kindsShown(panel);
        kinds.sort();
        QCOMPARE(kinds, QStringList({QStringLiteral("Stops, stands 1.6 s, starts again"), kTurn}));
        QCOMPARE(panel.headerText(), QStringLiteral("0 of 4 judged"));
        QCOMPARE(panel.listedNumbers().size(), std::size_t(4));
        const std::size_t row = placeOf(model, EventKind::stops);
        const std::size_t start = placeOf(model, EventKind::starts);
        const auto id = [&](std::size_t place) { return model.recordAt(static_cast<int>(place))->id; };
        QCOMPARE(model.rowIdOf(id(start)), id(row));
        QCOMPARE(model.rowIdOf(id(row)), id(row));
        const QModelIndex duration = model.index(static_cast<int>(row), EventsModel::duration_column);
        QCOMPARE(duration.data().toString(), QStringLiteral("1.6 s"));
    }

    void aLongKindLeavesRoomForTheOtherColumnsAndIsInTheTip() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(aStop()));
        panel.showCounts(0);
        const QString all = QStringLiteral("Stops, stands 1.6 s, starts again");
        const QTableView& table = *panel.table();
        QTRY_VERIFY(table.columnWidth(EventsModel::kind_column) > 0);
        const QAbstractItemView& view = table;
        const int whole = view.sizeHintForColumn(EventsModel::kind_column);
        const int width = table.columnWidth(EventsModel::kind_column);
        QVERIFY2(width < whole, qPrintable(QStringLiteral("%1 of %2").arg(width).arg(whole)));
        // How long it stands is seen still.
        const int cut = table.fontMetrics().horizontalAdvance(QStringLiteral(", starts again")) -
                        table.fontMetrics().horizontalAdvance(QStringLiteral(", …"));
        QVERIFY2(width >= whole - cut, qPrintable(QStringLiteral("%1 of %2 - %3").arg(width).arg(whole).arg(cut)));
        const int row = static_cast<int>(placeOf(model, EventKind::stops));
        const QString tip = model.index(row, EventsModel::kind_column).data(Qt::ToolTipRole).toString();
        QVERIFY2(tip.startsWith(all + QLatin1Char('\n')), qPrintable(tip));
        const int turn = static_cast<int>(placeOf(model, EventKind::turns_back));
        QCOMPARE(model.index(turn, EventsModel::kind_column).data(Qt::ToolTipRole).toString().count(kTurn), 1);
    }

    void whatIsJudgedOtherwiseOrHasANoteHasARowOfItsOwn() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(aStop()));
        judge(model, placeOf(model, EventKind::stands), Judgement::relevant);
        panel.showCounts(0);
        QVERIFY(kindsShown(panel).contains(QStringLiteral("Stops, starts again")));
        QVERIFY(kindsShown(panel).contains(QStringLiteral("Stands")));
        QCOMPARE(panel.headerText(), QStringLiteral("1 of 4 judged"));
        for (const EventKind kind : {EventKind::stops, EventKind::starts})
            judge(model, placeOf(model, kind), Judgement::relevant);
        panel.showCounts(0);
        QCOMPARE(kindsShown(panel).size(), 2);
        QCOMPARE(panel.headerText(), QStringLiteral("3 of 4 judged"));
        const std::size_t start = placeOf(model, EventKind::starts);
        verdicts_[start].note = "slowly";
        model.setVerdict(start, verdictAt(start));
        panel.showCounts(0);
        QVERIFY(kindsShown(panel).contains(QStringLiteral("Starts")));
    }

    void aRowTellsOnlyOfKindsThatAreListed() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(aStop()));
        panel.showCounts(0);
        panel.kinds().setShown(static_cast<int>(EventKind::stops), false);
        QVERIFY(kindsShown(panel).contains(QStringLiteral("Stands 1.6 s, starts")));
        QCOMPARE(panel.headerText(), QStringLiteral("0 of 4 judged · 3 of 4 shown"));
        QVERIFY(!panel.isShown(*model.recordAt(static_cast<int>(placeOf(model, EventKind::stops)))));
        QVERIFY(panel.isShown(*model.recordAt(static_cast<int>(placeOf(model, EventKind::starts)))));
    }

    void wordsOfTheFilterLineFindTheRowAndHideAllOfIt() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(aStop()));
        panel.showCounts(0);
        int told = 0;
        panel.setCommands({.listing_changed = [&] { ++told; }});
        panel.setFilterText(QStringLiteral("starts"));
        QCOMPARE(kindsShown(panel), QStringList(QStringLiteral("Stops, stands 1.6 s, starts again")));
        QCOMPARE(panel.headerText(), QStringLiteral("0 of 4 judged · 3 of 4 shown"));
        QVERIFY2(told > 0, "marks on the timeline follow");
        panel.setFilterText(QStringLiteral("turns"));
        QCOMPARE(kindsShown(panel), QStringList(kTurn));
        QVERIFY(!panel.isShown(*model.recordAt(static_cast<int>(placeOf(model, EventKind::starts)))));
    }
};

}  // namespace eyrie::ui::joined_stops_test

EYRIE_UI_TEST(QApplication, joined_stops_test, JoinedStopsTest)
#include "joined_stops_test.moc"
