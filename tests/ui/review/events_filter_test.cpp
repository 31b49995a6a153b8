#include <QComboBox>
#include <QScrollBar>
#include <QTableView>
#include <QTest>
#include <functional>
#include <optional>

#include "review/events/events_panel.h"
#include "review/tracks/track_query.h"
#include "ui/review/listed_events.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::events_filter_test {

using test::found;
using test::happening;
using test::someEvents;

/// Which events are listed, and how many are hidden by what.
class EventsFilterTest : public test::ListedEvents {
    Q_OBJECT

 private slots:
    void init() { begin(); }
    void cleanup() { end(); }

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

    void whatWasTaggedIsFoundByItsTags() {
        EventsModel model;
        EventsPanel panel(&model, *actions_);
        give(model, found(someEvents()));
        verdicts_[1].tags = {"gate 3", "lorry"};
        model.setVerdict(1, verdictAt(1));
        panel.showCounts(0);
        QVERIFY2(panel.table()->isColumnHidden(EventsModel::tags_column), "nobody has asked for it");
        QCOMPARE(model.index(1, EventsModel::tags_column).data().toString(), QStringLiteral("gate 3, lorry"));
        panel.setFilterText(QStringLiteral("lorry"));
        QCOMPARE(panel.headerText(), QStringLiteral("0 of 8 judged · 1 of 8 shown"));
        panel.setFilterText(QString());
        panel.verdicts().setCurrentText(QStringLiteral("With tags"));
        QCOMPARE(panel.headerText(), QStringLiteral("0 of 8 judged · 1 of 8 shown"));
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
};

}  // namespace eyrie::ui::events_filter_test

EYRIE_UI_TEST(QApplication, events_filter_test, EventsFilterTest)
#include "events_filter_test.moc"
