#include <QAbstractItemModelTester>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTableView>
#include <QTest>
#include <map>
#include <set>

#include "canvas/overlay_settings.h"
#include "review/events/event_thresholds.h"
#include "review/events/events_panel.h"
#include "review/tracks/track_query.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/display_text.h"
#include "widgets/layout/collapsible_section.h"
#include "widgets/parameters/parameter_row.h"
#include "widgets/tables/table_roles.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::events_list_test {

namespace {

Event happening(EventKind kind, TrackId track, FrameIndex frame) {
    Event event;
    event.kind = kind;
    event.tracks = {track};
    event.first_frame = event.frame = event.last_frame = frame;
    return event;
}

std::shared_ptr<const FoundEvents> found(std::vector<Event> events, int frames = 100, bool searched = true,
                                         const std::shared_ptr<const FoundEvents>& former = nullptr) {
    auto run = std::make_shared<StoredTracks>();
    if (searched) run->footage.camera = CameraMotion::standing(0, frames - 1);
    run->footage.image_size = {240, 180};
    run->footage.last_frame = frames - 1;
    run->footage.scale.frame_rate_hz = 25;
    return inOrder(run, {std::move(events), {}, {}}, {}, {}, former);
}

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

/// Six stops, a U-turn and a vehicle that was lost.
std::vector<Event> someEvents() {
    std::vector<Event> events;
    for (int i = 0; i < 6; ++i) events.push_back(happening(EventKind::stops, i + 1, 10 * i));
    events.push_back(happening(EventKind::turns_back, 7, 50));
    events.push_back(happening(EventKind::lost, 8, 80));
    return events;
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

/// The list of events by itself: order, filters, counts, notes, limits, and how much work many events are.
class EventsListTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;
    std::unique_ptr<OverlaySettings> overlays_;
    std::unique_ptr<QWidget> window_;
    std::unique_ptr<WindowActions> actions_;
    std::map<std::size_t, Verdict> verdicts_;

    const Verdict* verdictAt(std::size_t position) const {
        const auto at = verdicts_.find(position);
        return at == verdicts_.end() ? nullptr : &at->second;
    }
    void give(EventsModel& model, const std::shared_ptr<const FoundEvents>& events) const {
        model.setEvents(events, [this](std::size_t position) { return verdictAt(position); });
    }
    void judge(EventsModel& model, std::size_t position, Judgement judgement) {
        verdicts_[position].judgement = judgement;
        model.setVerdict(position, verdictAt(position));
    }
    static QStringList kindsShown(const EventsPanel& panel) {
        QStringList kinds;
        const auto* shown = panel.table()->model();
        for (int row = 0; row < shown->rowCount(); ++row)
            kinds << shown->index(row, EventsModel::kind_column).data().toString();
        return kinds;
    }

 private slots:
    void init() {
        home_ = std::make_unique<test::OwnHome>();
        overlays_ = std::make_unique<OverlaySettings>();
        window_ = std::make_unique<QWidget>();
        actions_ = std::make_unique<WindowActions>(*overlays_, window_.get());
        verdicts_.clear();
    }
    void cleanup() {
        actions_.reset();
        window_.reset();
        overlays_.reset();
        home_.reset();
    }

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

    void hiddenEventsAreCounted() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(someEvents()));
        panel.showCounts(0);
        QCOMPARE(panel.headerText(), QStringLiteral("0 of 8 judged"));
        judge(model, 0, Judgement::relevant);
        panel.kinds().setShown(static_cast<int>(EventKind::stops), false);
        QCOMPARE(kindsShown(panel), QStringList({QStringLiteral("Lost"), QStringLiteral("Turns back")}));
        QCOMPARE(panel.headerText(), QStringLiteral("1 of 8 judged · 2 of 8 shown"));
        panel.verdicts().setCurrentIndex(1);
        QCOMPARE(kindsShown(panel), QStringList(QStringLiteral("Turns back")));
        panel.showCounts(2);
        QVERIFY(panel.headerText().contains(QStringLiteral("without an event")));
    }

    void whatTheFilterLineHidesIsCountedAndWhenAllThatIsLeftIsJudgedItSaysSo() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(someEvents()));
        panel.showCounts(0);
        panel.setFilterText(QStringLiteral("turns"));
        QCOMPARE(panel.headerText(), QStringLiteral("0 of 8 judged · 1 of 8 shown"));
        QVERIFY(test::says(panel, QStringLiteral("1 of 8 shown")));
        judge(model, 1, Judgement::relevant);
        QCOMPARE(panel.headerText(), QStringLiteral("1 of 8 judged · 1 of 8 shown, all judged"));
        panel.setFilterText(QString());
        QCOMPARE(panel.headerText(), QStringLiteral("1 of 8 judged"));
    }

    void anotherFilterBeginsAtTheFirstRowThatIsLeft() {
        std::vector<Event> events;
        for (int i = 0; i < 60; ++i)
            events.push_back(happening(i % 2 == 0 ? EventKind::stops : EventKind::starts, i + 1, i));
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(events));
        panel.resize(400, 300);
        panel.show();
        panel.setFilterText(QStringLiteral("stops"));
        panel.selectId(model.recordAt(58)->id);
        QVERIFY(panel.table()->verticalScrollBar()->value() > 0);
        panel.setFilterText(QStringLiteral("st"));  // has it still
        QVERIFY(panel.table()->verticalScrollBar()->value() > 0);
        panel.setFilterText(QStringLiteral("starts"));
        QCOMPARE(panel.table()->verticalScrollBar()->value(), 0);
    }

    void chipsOfTheTracksNarrowTheEventsAndWhatTheyHideIsCounted() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        panel.resize(400, 400);
        panel.show();
        // Track n drives n px a frame. Besides what happens to one, 2 and 8 meet.
        std::vector<Event> events = someEvents();
        events.push_back(happening(EventKind::meeting, 2, 30));
        events.back().tracks = {2, 8};
        give(model, found(events));
        std::vector<TrackSummary> tracks(8);
        for (int i = 0; i < 8; ++i) {
            tracks[static_cast<std::size_t>(i)].id = i + 1;
            tracks[static_cast<std::size_t>(i)].last_frame = 99;
            tracks[static_cast<std::size_t>(i)].mean_speed_px = i + 1;
        }
        const auto doings = std::make_shared<DoingsByTrack>();
        for (int i = 0; i < 6; ++i) (*doings)[i + 1].standing = {{10 * i, 10 * i + 5}};
        const auto ask = [&](
                             const TrackFilter& filter, std::function<void()> clear = [] {}) {
            panel.setQuery(std::make_shared<const TrackQuery>(filter, tracks, SceneScale(),
                                                              TrackQuery::Known{doings, nullptr}, FrameOfDay()),
                           std::move(clear));
        };
        TrackFilter fast;
        fast.range(TrackQuality::speed) = {7, std::nullopt};
        ask(fast);
        QCOMPARE(kindsShown(panel).size(), 3);  // lost, turns back, and the meeting for one of the two
        QCOMPARE(panel.headerText(), QStringLiteral("0 of 9 judged · 3 of 9 shown · 6 hidden by the filter on tracks"));
        panel.kinds().setShown(static_cast<int>(EventKind::stops), false);
        QVERIFY2(!panel.headerText().contains(QStringLiteral("hidden by")), "stops are not wanted anyway");
        panel.kinds().showAll();

        // Times are those of the event, and "now" is when it happens.
        TrackFilter early;
        early.time.to = TimeLimit{10, false};
        ask(early);
        QCOMPARE(kindsShown(panel), QStringList({QStringLiteral("Stops"), QStringLiteral("Stops")}));
        TrackFilter standing;
        standing.conditions = {TrackCondition::stands_now};
        ask(standing);
        QCOMPARE(kindsShown(panel).filter(QStringLiteral("Stops")).size(), 6);
        QVERIFY(!kindsShown(panel).contains(QStringLiteral("Lost")));

        TrackFilter none;
        none.range(TrackQuality::speed) = {900, std::nullopt};
        int cleared = 0;
        ask(none, [&] {
            ++cleared;
            panel.setQuery(nullptr, {});
        });
        QVERIFY(test::says(panel, QStringLiteral("or by the filter on tracks")));
        QVERIFY(test::press(panel, QStringLiteral("Show all")));
        QCOMPARE(cleared, 1);
        QCOMPARE(kindsShown(panel).size(), 9);
    }

    void whatCouldNotBeSearchedIsHiddenByATimeAlone() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(someEvents(), 100, false));
        const QString unsearched = QStringLiteral("Not searched");
        const qsizetype all = kindsShown(panel).count(unsearched);
        QVERIFY(all > 0);
        TrackFilter filter;
        filter.range(TrackQuality::speed) = {900, std::nullopt};
        const auto ask = [&] {
            panel.setQuery(std::make_shared<const TrackQuery>(filter, std::vector<TrackSummary>(), SceneScale(),
                                                              TrackQuery::Known(), FrameOfDay()),
                           [] {});
        };
        ask();
        QCOMPARE(kindsShown(panel).count(unsearched), all);
        filter.time.from = TimeLimit{1000, false};
        ask();
        QCOMPARE(kindsShown(panel).count(unsearched), qsizetype(0));
    }

    void whereAllIsHiddenItSaysSoAndShowsItAgain() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(someEvents()));
        panel.resize(400, 400);
        panel.show();
        panel.kinds().showAll(false);
        QVERIFY(kindsShown(panel).isEmpty());
        QVERIFY(!panel.table()->isVisible());
        QVERIFY(test::says(panel, QStringLiteral("All 8 events")));
        QVERIFY(test::press(panel, QStringLiteral("Show all")));
        QCOMPARE(kindsShown(panel).size(), 8);
    }

    void theNextToJudgeIsTheNextOneShown() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(someEvents()));
        const auto id = [&](int row) { return model.recordAt(row)->id; };
        judge(model, 1, Judgement::unsure);
        QCOMPARE(panel.nextOpen({id(0)}), std::optional(id(2)));
        QCOMPARE(panel.nextOpen({id(7)}), std::optional(id(0)));  // around
        panel.kinds().setShown(static_cast<int>(EventKind::stops), false);
        QCOMPARE(panel.nextOpen({id(0)}), std::nullopt);
        panel.selectId(id(0));
        QCOMPARE(panel.neighbour(1), std::optional(id(1)));
        QCOMPARE(panel.neighbour(-1), std::nullopt);
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

    void limitsAreKeptAndShownWithTheirCounts() {
        {
            EventThresholds limits;
            QSignalSpy edited(&limits, &EventThresholds::edited);
            limits.setValue(QStringLiteral("events.over"), QStringLiteral("70"));
            QCOMPARE(edited.count(), 1);
            QCOMPARE(limits.options().over_kmh, 70.0);
            limits.setValue(QStringLiteral("events.over"), QStringLiteral("fast"));
            QCOMPARE(edited.count(), 1);
            EventKindsButton::Counts counts{};
            counts.at(static_cast<std::size_t>(EventKind::over_speed)) = 12;
            limits.setCounts(counts);
            bool told = false;
            for (const auto* title : limits.findChildren<QToolButton*>())
                told = told || title->text() == QStringLiteral("Over speed 12, Under speed 0");
            QVERIFY(told);
        }
        EventThresholds limits;
        QCOMPARE(limits.options().over_kmh, 70.0);
        limits.resetAll();
        QCOMPARE(limits.options().over_kmh, EventOptions().over_kmh);
        QCOMPARE(EventThresholds().options().over_kmh, EventOptions().over_kmh);
    }

    void everyLimitIsInTheForm() {
        const EventThresholds limits;
        EventOptions options;
        QCOMPARE(limits.findChildren<ParameterRow*>().size(),
                 static_cast<qsizetype>(listParameters(describeOf(options)).size()));
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
};

}  // namespace eyrie::ui::events_list_test

EYRIE_UI_TEST(QApplication, events_list_test, EventsListTest)
#include "events_list_test.moc"
