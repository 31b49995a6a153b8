#include "review/tracks/filter_chips.h"

#include <QCheckBox>
#include <QFrame>
#include <QHeaderView>
#include <QLineEdit>
#include <QPointer>
#include <QScrollBar>
#include <QTableView>
#include <QTest>
#include <QToolButton>

#include "review/tracks/tracks_panel.h"
#include "ui/review/filtered_tracks.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/tables/table_roles.h"

namespace eyrie::ui::filter_chips_test {

using test::happening;
using test::kMetres;
using test::tenTracks;
using test::threeDriven;
using test::trackOf;

/// The list of tracks as chips narrow it, and the columns that they are about.
class FilterChipsTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static std::vector<int> listed(const TracksPanel& panel) {
        std::vector<int> ids;
        const auto* shown = panel.table()->model();
        for (int row = 0; row < shown->rowCount(); ++row) ids.push_back(shown->index(row, 0).data(id_role).toInt());
        return ids;
    }

 private slots:
    void init() {
        QLocale::setDefault(QLocale::c());
        home_ = std::make_unique<test::OwnHome>();
    }
    void cleanup() { home_.reset(); }

    void theLowestAndTheHighestSpeedNarrowAndAreShownWhereTheyAreKnown() {
        // 36 and 72 km/h; track 3 was seen too shortly.
        const auto doings =
            std::make_shared<const DoingsByTrack>(doingsOf(*threeDriven(), {}, {{1, {0, 10}}, {2, {10, 20}}}));
        TrackFilter filter;
        filter.range(TrackQuality::highest) = {50, std::nullopt};
        QVERIFY(!filter.holds(trackOf(1), kMetres, {.doings = doings.get()}));
        QVERIFY(filter.holds(trackOf(2), kMetres, {.doings = doings.get()}));
        QVERIFY(!filter.holds(trackOf(3), kMetres, {.doings = doings.get()}));
        QVERIFY2(filter.holds(trackOf(1), kMetres, {}), "nobody knows yet");
        QCOMPARE(chipText(filter, TrackQuality::highest, kMetres), QStringLiteral("Highest speed ≥ 50 km/h"));
        QCOMPARE(TrackFilter::fromJson(filter.json()), filter);
        filter = {};
        filter.range(TrackQuality::lowest) = {std::nullopt, 0.0};
        QVERIFY(filter.holds(trackOf(1), kMetres, {.doings = doings.get()}));
        QVERIFY(!filter.holds(trackOf(2), kMetres, {.doings = doings.get()}));

        TracksModel model;
        TracksPanel panel(&model);
        panel.show();
        model.setTracks(tenTracks(), kMetres);
        const auto cell = [&](int row, int column) { return model.index(row, column).data().toString(); };
        QCOMPARE(cell(1, TracksModel::highest_column), QString());
        panel.setDoings(doings);
        QCOMPARE(cell(0, TracksModel::lowest_column), QStringLiteral("0.0"));
        QCOMPARE(cell(1, TracksModel::lowest_column), QStringLiteral("36.0"));
        QCOMPARE(cell(1, TracksModel::highest_column), QStringLiteral("72.0"));
        QCOMPARE(cell(2, TracksModel::highest_column), QString());
        panel.table()->sortByColumn(TracksModel::highest_column, Qt::DescendingOrder);
        QCOMPARE(listed(panel).at(0), 2);
        QCOMPARE(listed(panel).at(1), 1);
        model.setTracks(tenTracks(), {0.1, 25, false});  // 20 m/s are 8 px a frame there
        QCOMPARE(cell(1, TracksModel::highest_column), QStringLiteral("8.00"));
        QCOMPARE(model.headerData(TracksModel::highest_column, Qt::Horizontal, Qt::DisplayRole).toString(),
                 QStringLiteral("Highest (px/frame)"));
    }

    void howLongATrackStoodIsShownWhereItIsKnown() {
        // Track 1 stood twice, 2 never, of 3 nobody knows.
        const auto doings = std::make_shared<DoingsByTrack>();
        (*doings)[1].standing = {{100, 149}, {200, 224}};
        (*doings)[2].speeds = {10, 20};
        TracksModel model;
        TracksPanel panel(&model);
        model.setTracks(tenTracks(), kMetres);
        const auto cell = [&](int row) { return model.index(row, TracksModel::stood_column).data().toString(); };
        QCOMPARE(cell(0), QString());
        panel.setDoings(doings);
        QCOMPARE(cell(0), QStringLiteral("3.0"));  // 75 frames at 25 Hz
        QCOMPARE(cell(1), QStringLiteral("0.0"));
        QCOMPARE(cell(2), QString());
        panel.table()->sortByColumn(TracksModel::stood_column, Qt::DescendingOrder);
        QCOMPARE(listed(panel).at(0), 1);
        QCOMPARE(listed(panel).at(1), 2);
    }

    void columnsOfExtremesAreHiddenUntilSomebodyShowsThem() {
        TracksModel model;
        {
            TracksPanel panel(&model);
            model.setTracks(tenTracks(), kMetres);
            const QHeaderView* header = panel.table()->horizontalHeader();
            QVERIFY(panel.table()->isColumnHidden(TracksModel::lowest_column));
            QVERIFY(panel.table()->isColumnHidden(TracksModel::highest_column));
            QVERIFY(panel.table()->isColumnHidden(TracksModel::stood_column));
            QCOMPARE(header->visualIndex(TracksModel::lowest_column),
                     header->visualIndex(TracksModel::speed_column) + 1);
            panel.table()->showColumn(TracksModel::highest_column);
        }
        const TracksPanel panel(&model);
        QVERIFY(panel.table()->isColumnHidden(TracksModel::lowest_column));
        QVERIFY(!panel.table()->isColumnHidden(TracksModel::highest_column));
    }

    void theListFollowsTheFrameShownWhereAChipAsksForIt() {
        TracksModel model;
        TracksPanel panel(&model);
        panel.show();
        model.setTracks(tenTracks(), kMetres);  // all begin at 100
        panel.setShownFrame(0);
        TrackFilter moving;
        moving.conditions = {TrackCondition::moves_now};
        panel.chips().setFilter(moving);
        QVERIFY(listed(panel).empty());
        panel.setShownFrame(124 + 8 * 25);
        QTRY_COMPARE_WITH_TIMEOUT(listed(panel), (std::vector<int>{9, 10}), test::kPatience_ms);
    }

    void timesOfTheDayCanBeAskedForWhereTheyAreKnown() {
        TracksModel model;
        TracksPanel panel(&model);
        panel.resize(400, 400);
        panel.show();
        model.setTracks(tenTracks(), kMetres);
        QFrame* limits = panel.chips().openLimits(TrackQuality::time);
        QLineEdit* from = limits->findChildren<QLineEdit*>().front();
        from->setText(QStringLiteral("22:08"));
        QVERIFY2(!panel.chips().filter().any(), "nobody knows when it was");
        from->setText(QStringLiteral("325"));
        QCOMPARE(listed(panel), (std::vector<int>{10}));
        limits->close();
        ClockOfFrames clock;
        clock.time = [](FrameIndex) { return QStringLiteral("22:08:00"); };
        clock.origin = [] { return QStringLiteral("the start time given"); };
        int begin = 79'680;
        clock.frame_of_day = [&](double seconds, double) {
            return std::optional<FrameIndex>(static_cast<FrameIndex>(seconds) - begin);
        };
        model.setClock(clock);
        limits = panel.chips().openLimits(TrackQuality::time);
        limits->findChildren<QLineEdit*>().front()->setText(QStringLiteral("22:13:00"));  // frame 300
        limits->close();
        QCOMPARE(listed(panel), (std::vector<int>{9, 10}));
        begin += 25;
        model.setClock(clock);
        QCOMPARE(listed(panel), (std::vector<int>{8, 9, 10}));
    }

    void chipsNarrowTheListAndCountWhatIsHidden() {
        TracksModel model;
        TracksPanel panel(&model);
        panel.resize(340, 400);
        panel.show();
        model.setTracks(tenTracks(), kMetres);
        QCOMPARE(panel.countText(), QStringLiteral("10 of 10 tracks"));
        QFrame* limits = panel.chips().openLimits(TrackQuality::speed);
        const auto fields = limits->findChildren<QLineEdit*>();
        QCOMPARE(fields.size(), 2);
        fields[0]->setText(QStringLiteral("27"));
        fields[1]->setText(QStringLiteral("45,5"));
        limits->close();
        QCOMPARE(listed(panel), (std::vector<int>{3, 4, 5}));
        QCOMPARE(panel.countText(), QStringLiteral("3 of 10 tracks"));
        QVERIFY(test::press(panel, QStringLiteral("×")));
        QCOMPARE(panel.countText(), QStringLiteral("10 of 10 tracks"));

        // Words of the line above count as hidden, too.
        panel.setFilterText(QStringLiteral("nothing has this"));
        QCOMPARE(panel.countText(), QStringLiteral("0 of 10 tracks"));
        panel.setFilterText({});

        TrackFilter none;
        none.range(TrackQuality::speed) = {900, std::nullopt};
        panel.chips().setFilter(none);
        QCOMPARE(panel.countText(), QStringLiteral("0 of 10 tracks"));
        QVERIFY(test::says(panel, QStringLiteral("None of the 10 tracks")));
        QVERIFY(test::press(panel, QStringLiteral("Show all")));
        QCOMPARE(panel.countText(), QStringLiteral("10 of 10 tracks"));
    }

    void whatTracksDidIsAskedForAndThenNarrows() {
        TracksModel model;
        TracksPanel panel(&model);
        int asked = 0;
        panel.setCommands({.want_doings = [&] { ++asked; }});
        panel.show();
        model.setTracks(tenTracks(), kMetres);
        TrackFilter in_yard;
        in_yard.zones = {"yard"};
        panel.chips().setFilter(in_yard);
        QCOMPARE(listed(panel).size(), std::size_t(10));
        panel.chips().openLimits(TrackQuality::zone)->close();
        QCOMPARE(asked, 1);
        panel.setDoings(std::make_shared<const DoingsByTrack>(doingsOf(
            *threeDriven(), {happening(EventKind::enters, 1, "yard"), happening(EventKind::exits, 2, "yard")})));
        QCOMPARE(listed(panel), (std::vector<int>{1, 2}));
        QFrame* limits = panel.chips().openLimits(TrackQuality::event);
        for (QCheckBox* box : limits->findChildren<QCheckBox*>())
            if (box->text().startsWith(QStringLiteral("exits"))) box->click();
        limits->close();
        QCOMPARE(listed(panel), std::vector<int>{2});
    }

    void tracksLikeOneAreListedTheMostLikeFirst() {
        TracksModel model;
        TracksPanel panel(&model);
        std::vector<std::optional<TrackId>> asked;
        panel.setCommands({.want_likeness = [&](std::optional<TrackId> track) { asked.push_back(track); }});
        panel.resize(500, 400);
        panel.show();
        model.setTracks(tenTracks(), kMetres);
        panel.table()->sortByColumn(TracksModel::speed_column, Qt::DescendingOrder);
        QVERIFY(panel.table()->isColumnHidden(TracksModel::like_column));

        panel.listLike(4);
        QCOMPARE(asked, std::vector<std::optional<TrackId>>{4});
        QCOMPARE(chipText(panel.chips().filter(), TrackQuality::like, kMetres), QStringLiteral("Like 4"));
        QCOMPARE(panel.countText(), QStringLiteral("10 of 10 tracks"));  // nobody knows yet
        const auto likeness = std::make_shared<LikenessByTrack>();
        likeness->chosen = 4;
        likeness->likeness = {{1, 0.6}, {2, 0.49}, {3, 1.0}, {5, 0.2}, {9, 0.7}};
        panel.setLikeness(likeness);
        QCOMPARE(listed(panel), (std::vector<int>{4, 3, 9, 1}));
        QCOMPARE(panel.countText(), QStringLiteral("4 of 10 tracks"));
        QVERIFY(!panel.table()->isColumnHidden(TracksModel::like_column));
        QCOMPARE(panel.table()->model()->index(2, TracksModel::like_column).data().toString(), QStringLiteral("0.70"));

        QFrame* limits = panel.chips().openLimits(TrackQuality::like);
        auto* least = limits->findChild<QLineEdit*>();
        QVERIFY(least != nullptr);
        least->setText(QStringLiteral("0,2"));
        QCOMPARE(listed(panel), (std::vector<int>{4, 3, 9, 1, 2, 5}));
        least->setText(QStringLiteral("much"));
        QCOMPARE(panel.countText(), QStringLiteral("6 of 10 tracks"));
        limits->close();
        QCOMPARE(chipText(panel.chips().filter(), TrackQuality::like, kMetres), QStringLiteral("Like 4 ≥ 0.2"));
        QCOMPARE(asked.size(), std::size_t(1));

        QFrame* switches = panel.chips().openLimits(TrackQuality::like);
        const auto boxes = switches->findChildren<QCheckBox*>();
        QCOMPARE(boxes.size(), 4);
        boxes[3]->click();
        QCOMPARE(panel.chips().filter().like->counts, (LikenessChoice{.looks = true}));
        QCOMPARE(asked.size(), std::size_t(2));
        QCOMPARE(asked.back(), std::optional<TrackId>(4));
        QCOMPARE(listed(panel).size(), std::size_t(6));  // until the answer comes
        for (QCheckBox* box : boxes) box->click();
        QVERIFY2(boxes[3]->isChecked(), "something has to count");
        QCOMPARE(panel.chips().filter().like->counts, (LikenessChoice{false, false, false, true}));
        switches->close();

        for (QToolButton* button : panel.chips().findChildren<QToolButton*>())
            if (button->text() == QStringLiteral("×") && button->isVisible()) button->click();
        QCOMPARE(asked.back(), std::optional<TrackId>());
        QCOMPARE(panel.countText(), QStringLiteral("10 of 10 tracks"));
        QCOMPARE(listed(panel).front(), 10);  // the order of before
        QVERIFY(panel.table()->isColumnHidden(TracksModel::like_column));

        // What was ticked last counts for the next one, on the next day, too.
        TracksPanel tomorrow(&model);
        tomorrow.listLike(5);
        QCOMPARE(tomorrow.chips().filter().like->counts, (LikenessChoice{false, false, false, true}));
        QCOMPARE(tomorrow.chips().filter().like->track, TrackId(5));
    }

    void theMostLikeAreInViewAndSoIsHowMuch() {
        TracksModel model;
        TracksPanel panel(&model);
        panel.resize(300, 200);
        panel.show();
        std::vector<TrackSummary> many;
        for (int n = 1; n <= 100; ++n) many.push_back(trackOf(n));
        model.setTracks(many, kMetres);
        for (const TrackId chosen : {90, 80}) {
            panel.table()->scrollToBottom();
            panel.listLike(chosen);
            const auto likeness = std::make_shared<LikenessByTrack>();
            likeness->chosen = chosen;
            for (int n = 1; n <= 100; ++n)
                if (n != chosen) likeness->likeness[n] = 0.5 + 0.004 * n;
            panel.setLikeness(likeness);
            QCOMPARE(listed(panel).front(), chosen);
            QCOMPARE(panel.table()->verticalScrollBar()->value(), 0);
        }
        const QModelIndex like = panel.table()->model()->index(0, TracksModel::like_column);
        QVERIFY(panel.table()->viewport()->rect().contains(panel.table()->visualRect(like)));
    }

    void enterClosesALimitThatCanBeRead() {
        FilterChips chips;
        chips.show();
        const QPointer<QFrame> limits = chips.openLimits(TrackQuality::speed);
        auto* from = limits->findChild<QLineEdit*>();
        from->setText(QStringLiteral("fast"));
        QTest::keyClick(from, Qt::Key_Return);
        QVERIFY(limits->isVisible());
        from->setText(QStringLiteral("50"));
        QTest::keyClick(from, Qt::Key_Return);
        QVERIFY(limits == nullptr || !limits->isVisible());
        QCOMPARE(chips.filter().range(TrackQuality::speed).from, std::optional(50.0));
    }

    void likenessToAnotherTrackCountsForNothing() {
        TracksModel model;
        TracksPanel panel(&model);
        panel.show();
        model.setTracks(tenTracks(), kMetres);
        const auto of_four = std::make_shared<LikenessByTrack>();
        of_four->chosen = 4;
        panel.setLikeness(of_four);  // nobody asked
        QCOMPARE(listed(panel).size(), std::size_t(10));
        panel.listLike(4);
        panel.setLikeness(of_four);
        QCOMPARE(listed(panel), std::vector<int>{4});
        panel.listLike(7);
        QCOMPARE(listed(panel).size(), std::size_t(10));
        panel.setLikeness(of_four);  // comes late
        QCOMPARE(listed(panel).size(), std::size_t(10));
        panel.listLike(std::nullopt);
        QVERIFY(!panel.chips().filter().any());
    }

    void filtersAreKeptByName() {
        TrackFilter fast;
        fast.range(TrackQuality::speed) = {50.0, std::nullopt};
        {
            FilterChips chips;
            chips.setFilter(fast);
            chips.keepAs(QStringLiteral("fast ones"));
        }
        FilterChips chips;
        QCOMPARE(chips.keptNames(), QStringList(QStringLiteral("fast ones")));
        chips.useKept(QStringLiteral("fast ones"));
        QCOMPARE(chips.filter(), fast);
        chips.forgetKept(QStringLiteral("fast ones"));
        QVERIFY(chips.keptNames().isEmpty());
        chips.useKept(QStringLiteral("never kept"));
        QCOMPARE(chips.filter(), TrackFilter());
    }
};

}  // namespace eyrie::ui::filter_chips_test

EYRIE_UI_TEST(QApplication, filter_chips_test, FilterChipsTest)
#include "filter_chips_test.moc"
