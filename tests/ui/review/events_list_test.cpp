#include <QAbstractItemModelTester>
#include <QHeaderView>
#include <QLineEdit>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTableView>
#include <QTest>
#include <map>
#include <set>

#include "review/events/events_panel.h"
#include "ui/review/listed_events.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/display_text.h"
#include "widgets/tables/table_roles.h"

namespace eyrie::ui::events_list_test {

using test::found;
using test::happening;
using test::someEvents;

namespace {

Event happeningAt(EventKind kind, TrackId track, FrameIndex frame, double x) {
    Event event = happening(kind, track, frame);
    event.place = event.ground = {x, 60};
    event.ground_frame = frame;
    return event;
}

/// Ids of rows by the first track of their events.
std::map<TrackId, int> idsByTrack(const EventsModel& model) {
    std::map<TrackId, int> ids;
    for (int row = 0; row < model.rowCount(); ++row) {
        const EventEntry& entry = *model.recordAt(row);
        ids[model.found()->eventAt(entry.position)->tracks.front()] = entry.id;
    }
    return ids;
}

/// Counts the texts it is asked for.
class CountingModel : public EventsModel {
 public:
    using EventsModel::EventsModel;
    QVariant data(const QModelIndex& index, int role) const override {
        if (role == Qt::DisplayRole) ++texts;
        return EventsModel::data(index, role);
    }
    mutable int texts = 0;
};

}  // namespace

/// The list of events by itself: order, columns, notes, what stays when others come, and how much work many are.
class EventsListTest : public test::ListedEvents {
    Q_OBJECT

 private slots:
    void init() { begin(); }
    void cleanup() { end(); }

    void whatMattersMostComesFirst() {
        EventsModel model;
        give(model, found(someEvents()));
        const EventsPanel panel(&model, *actions_);
        const QString stops = QStringLiteral("Stops");
        QCOMPARE(kindsShown(panel), QStringList({QStringLiteral("Lost"), QStringLiteral("Turns back"), stops, stops,
                                                 stops, stops, stops, stops}));
    }

    void whatWasFoundWhileARunWorkedIsTheSameWhenItIsDone() {
        const auto so_far =
            found({happeningAt(EventKind::stops, 1, 10, 20), happeningAt(EventKind::turns_back, 2, 20, 120),
                   happeningAt(EventKind::turns_back, 3, 22, 220)});
        EventsModel model;
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        EventsPanel panel(&model, *actions_);
        give(model, so_far);
        const std::map<TrackId, int> before = idsByTrack(model);
        QCOMPARE(kindsShown(panel).front(), QStringLiteral("Stops"));
        panel.selectId(before.at(2));
        QSignalSpy resets(&model, &QAbstractItemModel::modelReset);
        // Its tracks have other numbers, times and places are a little others, and stops are no longer rare.
        std::vector<Event> whole{happeningAt(EventKind::stops, 11, 11, 22),
                                 happeningAt(EventKind::turns_back, 12, 19, 118),
                                 happeningAt(EventKind::turns_back, 13, 22, 221)};
        for (int i = 0; i < 7; ++i) whole.push_back(happeningAt(EventKind::stops, 20 + i, 120 + 10 * i, 20));
        whole.push_back(happeningAt(EventKind::lost, 30, 190, 20));
        give(model, found(whole, 200, true, so_far));
        QCOMPARE(kindsShown(panel).mid(0, 4), QStringList({QStringLiteral("Lost"), QStringLiteral("Turns back"),
                                                           QStringLiteral("Turns back"), QStringLiteral("Stops")}));
        const std::map<TrackId, int> after = idsByTrack(model);
        QCOMPARE(after.size(), whole.size());
        QCOMPARE(after.at(11), before.at(1));
        QCOMPARE(after.at(12), before.at(2));
        QCOMPARE(after.at(13), before.at(3));
        std::set<int> ids;
        for (const auto& [track, id] : after) ids.insert(id);
        QCOMPARE(ids.size(), whole.size());
        QCOMPARE(panel.currentId(), before.at(2));
        QVERIFY2(resets.isEmpty(), "the list is not begun anew");
    }

    void whatIsReadStaysInPlaceWhenOthersCome() {
        std::vector<Event> events;
        for (int i = 0; i < 300; ++i) events.push_back(happening(EventKind::stops, i + 1, 10 * i));
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        panel.resize(500, 500);
        panel.show();
        give(model, found(events, 3000));
        QCoreApplication::processEvents();
        QTableView& table = *panel.table();
        table.verticalScrollBar()->setValue(100);
        const auto top = [&] { return table.indexAt({0, 0}).data(id_role).toInt(); };
        const int read = top();
        QVERIFY(table.verticalScrollBar()->value() > 0);
        events.push_back(happening(EventKind::lost, 400, 2990));  // comes first in the list
        panel.keepPlace([&] { give(model, found(events, 3000)); });
        QCoreApplication::processEvents();
        QCOMPARE(top(), read);
    }

    void whatCouldNotBeSearchedIsListedAndExplained() {
        EventsModel model;
        give(model, found(someEvents(), 100, false));
        const EventsPanel panel(&model, *actions_);
        QCOMPARE(kindsShown(panel).front(), QStringLiteral("Not searched"));
        const QModelIndex first = model.index(0, EventsModel::kind_column);
        QVERIFY(first.data(Qt::ToolTipRole).toString().contains(QStringLiteral("Look for yourself")));
    }

    void timesOfTheDayStandThereWhereTheyAreKnown() {
        EventsModel model;
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        give(model, found(someEvents()));
        const EventsPanel panel(&model, *actions_);
        // The vehicle that was lost in frame 80.
        const QModelIndex time = model.index(0, EventsModel::time_column);
        const auto title = [&] {
            return model.headerData(EventsModel::time_column, Qt::Horizontal, Qt::DisplayRole).toString();
        };
        const QString in_video = time.data().toString();
        QCOMPARE(title(), QStringLiteral("Time"));
        ClockOfFrames clock;
        clock.time = [](FrameIndex frame) { return frame == 80 ? QStringLiteral("22:08:25") : QString(); };
        clock.text = [](FrameIndex) { return QStringLiteral("2009-01-12 22:08:25.200 UTC"); };
        clock.origin = [] { return QStringLiteral("the start time given"); };
        QSignalSpy told(&model, &EventsModel::dataChanged);
        model.setClock(clock);
        QCOMPARE(told.count(), 1);
        QCOMPARE(time.data().toString(), QStringLiteral("22:08:25"));
        QCOMPARE(title(), QStringLiteral("Time (UTC)"));
        const QString tip = time.data(Qt::ToolTipRole).toString();
        QVERIFY2(tip.contains(QStringLiteral("2009-01-12 22:08:25.200 UTC")), qPrintable(tip));
        QVERIFY2(tip.contains(in_video + QStringLiteral(" in the video")), qPrintable(tip));
        const QModelIndex other = model.index(1, EventsModel::time_column);
        QVERIFY2(!other.data().toString().isEmpty(), "where nobody knows, the time of the video");
        model.setClock({});
        QCOMPARE(time.data().toString(), in_video);
        QCOMPARE(title(), QStringLiteral("Time"));
    }

    void durationAndSpeedsAreThoseOfTheTimeThatAnEventLasts() {
        EventsModel model;
        const EventsPanel panel(&model, *actions_);
        auto run = std::make_shared<StoredTracks>();
        run->footage.camera = CameraMotion::standing(0, 4999);
        run->footage.image_size = {240, 180};
        run->footage.last_frame = 4999;
        run->footage.scale = {0.1, 25, true};
        const auto show = [&] {
            // A long stand, a moment of which nobody knows how fast it was, and a drive of two minutes.
            TrackFindings findings;
            findings.events = {happening(EventKind::stands, 1, 100), happening(EventKind::stops, 2, 300),
                               happening(EventKind::loiters, 3, 400)};
            findings.events[0].last_frame = 199;
            findings.events[2].last_frame = 400 + 125 * 25 - 1;
            findings.event_speeds = {SpeedRange{0, 1}, std::nullopt, SpeedRange{5, 10}};
            give(model, inOrder(run, std::move(findings), {}));
        };
        const auto cell = [&](TrackId track, int column, int role = Qt::DisplayRole) {
            for (int row = 0; row < model.rowCount(); ++row)
                if (model.index(row, EventsModel::tracks_column).data().toString() == QString::number(track))
                    return model.index(row, column).data(role);
            return QVariant();
        };
        const auto text = [&](TrackId track, int column) { return cell(track, column).toString(); };
        show();
        QCOMPARE(text(1, EventsModel::duration_column), QStringLiteral("4.0 s"));
        QCOMPARE(text(2, EventsModel::duration_column), QString());
        QCOMPARE(text(3, EventsModel::duration_column), durationText(125));
        QVERIFY2(text(3, EventsModel::duration_column).startsWith(QStringLiteral("2:05")), "minutes and seconds");
        QVERIFY(cell(1, EventsModel::duration_column, sort_role).toDouble() <
                cell(3, EventsModel::duration_column, sort_role).toDouble());
        QCOMPARE(text(1, EventsModel::lowest_column), QStringLiteral("0.0"));
        QCOMPARE(text(3, EventsModel::lowest_column), QStringLiteral("18.0"));  // km/h
        QCOMPARE(text(3, EventsModel::highest_column), QStringLiteral("36.0"));
        QCOMPARE(text(2, EventsModel::highest_column), QString());
        const auto title = [&](int column) {
            return model.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
        };
        QCOMPARE(title(EventsModel::highest_column), QStringLiteral("Highest (km/h)"));
        const QHeaderView* header = panel.table()->horizontalHeader();
        QVERIFY(!header->isSectionHidden(EventsModel::duration_column));
        QVERIFY(header->isSectionHidden(EventsModel::lowest_column));
        QVERIFY(header->isSectionHidden(EventsModel::highest_column));
        QCOMPARE(header->visualIndex(EventsModel::duration_column),
                 header->visualIndex(EventsModel::figure_column) + 1);

        // Without a scale that is known: 10 m/s are 4 px a frame at 0.1 m/px.
        run = std::make_shared<StoredTracks>(*run);
        run->footage.scale.gsd_known = false;
        QSignalSpy titles(&model, &EventsModel::headerDataChanged);
        show();
        QCOMPARE(text(3, EventsModel::highest_column), QStringLiteral("4.00"));
        QCOMPARE(title(EventsModel::highest_column), QStringLiteral("Highest (px/frame)"));
        QCOMPARE(titles.count(), 1);
    }

    void whoJudgedAndWhenIsInTheTip() {
        EventsModel model;
        give(model, found(someEvents()));
        const auto tip = [&model](int row) {
            return model.index(row, EventsModel::kind_column).data(Qt::ToolTipRole).toString();
        };
        verdicts_[0].person = "Anna";
        verdicts_[0].when_utc = "2001-03-04T12:00:00Z";
        judge(model, 0, Judgement::relevant);
        QVERIFY2(tip(0).contains(QStringLiteral("\nRelevant: Anna, ")), qPrintable(tip(0)));
        QVERIFY2(tip(0).contains(QStringLiteral("2001")), qPrintable(tip(0)));
        QVERIFY2(!tip(1).contains(QStringLiteral("Anna")), qPrintable(tip(1)));
        judge(model, 0, Judgement::open);  // its note or star is hers still
        QVERIFY2(tip(0).contains(QStringLiteral("\nAnna, ")), qPrintable(tip(0)));
        verdicts_[1].person.clear();
        judge(model, 1, Judgement::unsure);
        QVERIFY2(tip(1).endsWith(QStringLiteral("\nUnsure")), qPrintable(tip(1)));
    }

    void noteAndTagsAreInTheTipSinceTheirColumnsMayBeOutOfView() {
        EventsModel model;
        give(model, found(someEvents()));
        verdicts_[0].note = "stands at the gate";
        verdicts_[0].tags = {"bus", "lorry"};
        judge(model, 0, Judgement::relevant);
        const auto tip = [&model](int row) {
            return model.index(row, EventsModel::kind_column).data(Qt::ToolTipRole).toString();
        };
        QVERIFY2(tip(0).endsWith(QStringLiteral("\nNote: stands at the gate\nTags: bus, lorry")), qPrintable(tip(0)));
        QVERIFY2(!tip(1).contains(QStringLiteral("Note")), qPrintable(tip(1)));
    }

    void anEventStaysSelectedWhenLimitsChange() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(someEvents()));
        const int id = model.recordAt(4)->id;
        panel.selectId(id);
        std::vector<Event> fewer = someEvents();
        fewer.erase(fewer.begin());
        give(model, found(fewer));
        QCOMPARE(panel.currentId(), id);
        QCOMPARE(model.found()->eventAt(static_cast<std::size_t>(model.rowOf(id)))->tracks, std::vector<TrackId>{3});
    }

    void theLastOfTheListStaysSelectedWhenTheListGetsShorter() {
        std::vector<Event> ten;
        for (int i = 0; i < 10; ++i) ten.push_back(happening(EventKind::stops, i + 1, 10 * i));
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(ten));
        const int last = model.recordAt(9)->id;
        panel.selectId(last);
        QSignalSpy resets(&model, &QAbstractItemModel::modelReset);
        give(model, found(std::vector<Event>(ten.begin() + 2, ten.end())));
        QCOMPARE(model.rowCount(), 8);
        QVERIFY(resets.isEmpty());
        QCOMPARE(panel.table()->selectionModel()->selectedRows().size(), 1);
        QCOMPARE(panel.currentId(), last);
    }

    void eventsWhoseTracksChangedNumbersAreTheSameStill() {
        const auto so_far =
            found({happeningAt(EventKind::turns_back, 1, 20, 20), happeningAt(EventKind::turns_back, 2, 20, 220)});
        EventsModel model;
        give(model, so_far);
        const std::map<TrackId, int> before = idsByTrack(model);
        give(model,
             found({happeningAt(EventKind::turns_back, 2, 20, 20), happeningAt(EventKind::turns_back, 1, 20, 220)}, 100,
                   true, so_far));
        const std::map<TrackId, int> after = idsByTrack(model);
        QCOMPARE(after.at(2), before.at(1));
        QCOMPARE(after.at(1), before.at(2));
        // From then on they are known by the numbers they have now.
        give(model,
             found({happeningAt(EventKind::turns_back, 2, 20, 20), happeningAt(EventKind::turns_back, 1, 20, 220)}));
        QCOMPARE(idsByTrack(model), after);
    }

    void aNoteIsWrittenInPlace() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(someEvents()));
        panel.resize(600, 400);
        panel.show();
        QSignalSpy edited(&model, &EventsModel::noteEdited);
        const int id = model.recordAt(2)->id;
        panel.selectId(id);
        QTest::keyClick(panel.table(), Qt::Key_F2);
        auto* editor = panel.table()->viewport()->findChild<QLineEdit*>();
        QVERIFY(editor != nullptr);
        QTest::keyClicks(editor, QStringLiteral("white van"));
        QTest::keyClick(editor, Qt::Key_Return);
        QVERIFY(QTest::qWaitFor([&] { return edited.count() == 1; }, test::kPatience_ms));
        QCOMPARE(edited.front().front().toInt(), id);
        QCOMPARE(edited.front().back().toString(), QStringLiteral("white van"));
    }

    void tenThousandEventsAreLittleWork() {
        std::vector<Event> many;
        many.reserve(10'000);
        for (int i = 0; i < 10'000; ++i) many.push_back(happening(static_cast<EventKind>(i % kEventKinds), i, i));
        CountingModel model;
        EventsPanel panel(&model, *actions_);
        panel.resize(500, 500);
        panel.show();
        give(model, found(many, 10'000));
        panel.showCounts(0);
        QCoreApplication::processEvents();
        // Texts are made of rows in view, and of some more for the widths of columns.
        QVERIFY2(model.texts < 20'000, qPrintable(QString::number(model.texts)));
        QSignalSpy resets(&model, &QAbstractItemModel::modelReset);
        model.texts = 0;
        for (int i = 0; i < 10; ++i) {
            judge(model, static_cast<std::size_t>(500 * i), Judgement::relevant);
            panel.showCounts(0);
            panel.selectId(*panel.nextOpen({model.recordAt(500 * i)->id}));
            QCoreApplication::processEvents();
        }
        QCOMPARE(resets.count(), 0);
        QVERIFY2(model.texts < 20'000, qPrintable(QString::number(model.texts)));
        QCOMPARE(panel.headerText(), QStringLiteral("10 of 10000 judged"));
    }

    void inANarrowListANoteIsWrittenInALineThatIsWideEnoughAndEnterOnlyEndsIt() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(someEvents()));
        panel.resize(330, 400);
        panel.show();
        QTableView* table = panel.table();
        const int id = model.recordAt(2)->id;
        panel.selectId(id);
        int shown = 0;
        panel.setCommands({.show = [&](int) { ++shown; }});
        QVERIFY2(table->horizontalScrollBar()->maximum() > 0, "otherwise this shows nothing");
        panel.editNote(id);
        auto* editor = table->viewport()->findChild<QLineEdit*>();
        QVERIFY(editor != nullptr);
        QVERIFY2(editor->width() >= 200, qPrintable(QString::number(editor->width())));
        QVERIFY(table->viewport()->rect().contains(editor->geometry()));
        QCOMPARE(table->horizontalScrollBar()->value(), 0);  // number and time stay in view
        QSignalSpy edited(&model, &EventsModel::noteEdited);
        QTest::keyClicks(editor, QStringLiteral("white van"));
        QTest::keyClick(editor, Qt::Key_Return);
        QVERIFY(QTest::qWaitFor([&] { return edited.count() == 1; }, test::kPatience_ms));
        QCOMPARE(shown, 0);  // the video stays where it is
    }
};

}  // namespace eyrie::ui::events_list_test

EYRIE_UI_TEST(QApplication, events_list_test, EventsListTest)
#include "events_list_test.moc"
