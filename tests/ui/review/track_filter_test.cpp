#include <QCheckBox>
#include <QFrame>
#include <QHeaderView>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLineEdit>
#include <QTableView>
#include <QTest>
#include <QToolButton>
#include <numbers>

#include "review/events/found_events.h"
#include "review/tracks/filter_chips.h"
#include "review/tracks/tracks_panel.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/tables/table_roles.h"

namespace eyrie::ui::track_filter_test {

namespace {

constexpr double kPi = std::numbers::pi;
const SceneScale kMetres{0.1, 25, true};

/// Track n is n frames long and drives n px a frame: at 0.1 m/px and 25 Hz 9·n km/h.
TrackSummary trackOf(int n) {
    TrackSummary track;
    track.id = n;
    track.first_frame = 100;
    track.last_frame = 100 + 25 * n - 1;
    track.frames = 25 * n;
    track.confirmed = true;
    track.mean_speed_px = n;
    track.mean_length_px = 40;
    track.score = n / 10.0;
    return track;
}

std::vector<TrackSummary> tenTracks() {
    std::vector<TrackSummary> tracks;
    for (int n = 1; n <= 10; ++n) tracks.push_back(trackOf(n));
    return tracks;
}

/// Track 1 drives right and enters the yard; track 2 drives down and is lost; track 3 stands.
std::shared_ptr<StoredTracks> threeDriven() {
    auto run = std::make_shared<StoredTracks>();
    run->footage.image_size = {640, 400};
    run->footage.last_frame = 99;
    run->footage.scale = kMetres;
    std::vector<Homography> steps;  // the picture drifts to the left by a pixel a frame
    for (int frame = 1; frame < 100; ++frame) {
        Homography step;
        step.from_frame = frame - 1;
        step.to_frame = frame;
        step.matrix = {1, 0, -1, 0, 1, 0, 0, 0, 1};
        steps.push_back(step);
    }
    run->footage.camera = CameraMotion(steps);
    const auto drive = [&](TrackId id, cv::Point2d speed) {
        EventTrack track;
        track.id = id;
        for (int frame = 0; frame < 100; ++frame)
            track.boxes.push_back({frame, {cv::Point2d(200 - frame, 200) + speed * frame, 20, 8, 0}});
        run->tracks.push_back(track);
    };
    drive(1, {2, 0});
    drive(2, {0.1, 1});
    drive(3, {0, 0});
    return run;
}

Event happening(EventKind kind, TrackId track, const std::string& zone = "") {
    Event event;
    event.kind = kind;
    event.tracks = {track};
    event.zone = zone;
    return event;
}

}  // namespace

/// What narrows the list of tracks.
class TrackFilterTest : public QObject {
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

    void limitsAreInTheUnitsShownAndIncludeTheirEnds() {
        TrackFilter filter;
        QVERIFY(!filter.any());
        QVERIFY(filter.holds(trackOf(3), kMetres, {}));
        filter.range(TrackQuality::speed) = {27.0, 45.0};
        QVERIFY(!filter.holds(trackOf(2), kMetres, {}));
        QVERIFY(filter.holds(trackOf(3), kMetres, {}));
        QVERIFY(filter.holds(trackOf(5), kMetres, {}));
        QVERIFY(!filter.holds(trackOf(6), kMetres, {}));
        QVERIFY2(!filter.holds(trackOf(3), {0.1, 25, false}, {}), "3 px/frame");
        QCOMPARE(chipText(filter, TrackQuality::speed, kMetres), QStringLiteral("Speed 27–45 km/h"));
        filter.clear(TrackQuality::speed);
        filter.range(TrackQuality::life) = {std::nullopt, 4.0};
        QVERIFY(filter.holds(trackOf(4), kMetres, {}));
        QVERIFY(!filter.holds(trackOf(5), kMetres, {}));
        QCOMPARE(chipText(filter, TrackQuality::life, kMetres), QStringLiteral("Life ≤ 4 s"));
    }

    void directionsEventsAndZonesComeFromTheGroundAndTheEvents() {
        QCOMPARE(eighthOf(0), 0);
        QCOMPARE(eighthOf(kPi / 2), 2);
        QCOMPARE(eighthOf(-kPi / 2), 6);
        QCOMPARE(eighthOf(-kPi), 4);
        QCOMPARE(eighthOf(kPi / 8 - 0.01), 0);
        const DoingsByTrack doings =
            doingsOf(*threeDriven(), {happening(EventKind::enters, 1, "yard"), happening(EventKind::lost, 2)});
        QCOMPARE(doings.at(1).eighth, std::optional(0));
        QCOMPARE(doings.at(2).eighth, std::optional(2));
        QVERIFY2(!doings.contains(3), "what drifts with the picture only stands");
        TrackFilter filter;
        filter.eighths = {0, 1};
        QVERIFY(filter.holds(trackOf(1), kMetres, {.doings = &doings}));
        QVERIFY(!filter.holds(trackOf(2), kMetres, {.doings = &doings}));
        QVERIFY(!filter.holds(trackOf(3), kMetres, {.doings = &doings}));
        QVERIFY2(filter.holds(trackOf(2), kMetres, {}), "nobody knows yet");
        filter = {};
        filter.events = {EventKind::lost, EventKind::stands};
        QVERIFY(filter.holds(trackOf(2), kMetres, {.doings = &doings}));
        QVERIFY(!filter.holds(trackOf(1), kMetres, {.doings = &doings}));
        filter = {};
        filter.zones = {"yard"};
        QVERIFY(filter.holds(trackOf(1), kMetres, {.doings = &doings}));
        QVERIFY(!filter.holds(trackOf(2), kMetres, {.doings = &doings}));
        QCOMPARE(chipText(filter, TrackQuality::zone, kMetres), QStringLiteral("Zone yard"));
    }

    void aTimeIsAFrameOrATimeOfTheDay() {
        QCOMPARE(timeLimitOf(QStringLiteral(" 120 ")), std::optional(TimeLimit{120, false}));
        QCOMPARE(timeLimitOf(QStringLiteral("22:08")), std::optional(TimeLimit{79'680, true}));
        QCOMPARE(timeLimitOf(QStringLiteral("0:00:07")), std::optional(TimeLimit{7, true}));
        for (const char* wrong : {"", "noon", "-3", "1.5", "24:00", "12:60", "12:00:60", "12:5", "12:00:"})
            QVERIFY2(!timeLimitOf(QString::fromLatin1(wrong)), wrong);
        QCOMPARE(timeLimitText({79'680, true}), QStringLiteral("22:08"));
        QCOMPARE(timeLimitText({7, true}), QStringLiteral("00:00:07"));

        // Track 1 lies in frames 100 to 124, track 3 in 100 to 174.
        TrackFilter filter;
        filter.time = {TimeLimit{125, false}, std::nullopt};
        QVERIFY(!filter.holds(trackOf(1), kMetres, {}));
        QVERIFY(filter.holds(trackOf(3), kMetres, {}));
        QCOMPARE(chipText(filter, TrackQuality::time, kMetres), QStringLiteral("Time ≥ frame 125"));
        filter.time = {std::nullopt, TimeLimit{99, false}};
        QVERIFY(!filter.holds(trackOf(3), kMetres, {}));
        filter.time.to = TimeLimit{100, false};
        QVERIFY(filter.holds(trackOf(3), kMetres, {}));

        // Begun at 22:08:00; a frame is a second.
        const TrackFacts clock{.frame_of_day = [](double seconds, double) {
            return std::optional<FrameIndex>(static_cast<FrameIndex>(seconds) - 79'680);
        }};
        filter.time = {timeLimitOf(QStringLiteral("22:10:05")), timeLimitOf(QStringLiteral("22:20"))};
        QVERIFY(!filter.holds(trackOf(1), kMetres, clock));
        QVERIFY(filter.holds(trackOf(3), kMetres, clock));
        QVERIFY2(filter.holds(trackOf(1), kMetres, {}), "nobody knows the time");
        QCOMPARE(chipText(filter, TrackQuality::time, kMetres), QStringLiteral("Time 22:10:05–22:20 UTC"));
        filter.time = {std::nullopt, timeLimitOf(QStringLiteral("22:09:39"))};
        QVERIFY(!filter.holds(trackOf(1), kMetres, clock));
        filter.time.to = timeLimitOf(QStringLiteral("22:09:40"));  // shown for all of its second
        QVERIFY(filter.holds(trackOf(1), kMetres, clock));
    }

    void twoTimesOfTheDayAreOfTheDaysThatFitTheVideo() {
        // What is asked for, in seconds: from and to, each with what lies between them.
        std::vector<double> asked;
        const FrameOfDay frame_of_day = [&](double seconds, double near) {
            asked.insert(asked.end(), {seconds, near});
            return std::optional<FrameIndex>(static_cast<FrameIndex>(asked.size()));
        };
        const auto framesAsked = [&](const char* from, const char* to) {
            asked.clear();
            return framesOf({timeLimitOf(QString::fromLatin1(from)), timeLimitOf(QString::fromLatin1(to))},
                            frame_of_day);
        };
        const FrameSpan day = framesAsked("06:00", "22:00");
        QCOMPARE(day.first, 2);
        QCOMPARE(day.last, 3);
        QCOMPARE(asked, (std::vector<double>{21'600, 50'400.5, 79'201, 50'400.5}));
        framesAsked("22:00", "06:00");  // over midnight
        QCOMPARE(asked, (std::vector<double>{79'200, 93'600.5, 108'001, 93'600.5}));
        framesAsked("22:00", "");
        QCOMPARE(asked, (std::vector<double>{79'200, 79'200}));

        int times = 0;
        const FrameOfDay once = remembering([&](double, double) { return std::optional<FrameIndex>(++times); });
        QCOMPARE(once(1, 1), std::optional(1));
        QCOMPARE(once(1, 1), std::optional(1));
        QCOMPARE(once(1, 2), std::optional(2));
    }

    void statesAreOfTheFrameShownOrOfTheWholeTrack() {
        const auto at = [](EventKind kind, TrackId track, FrameIndex first, FrameIndex last) {
            Event event = happening(kind, track);
            event.first_frame = event.frame = first;
            event.last_frame = last;
            return event;
        };
        // Track 1 stands until 20 and from 60 to 79; track 2 stands from 50 on; track 3 stands.
        const DoingsByTrack doings =
            doingsOf(*threeDriven(), {at(EventKind::stands, 3, 0, 99), at(EventKind::starts, 1, 21, 21),
                                      at(EventKind::stops, 2, 50, 50), at(EventKind::stops, 1, 60, 60),
                                      at(EventKind::starts, 1, 80, 80), at(EventKind::lost, 2, 99, 99)});
        QCOMPARE(doings.at(1).standing, (std::vector<FrameSpan>{{0, 20}, {60, 79}}));
        QCOMPARE(doings.at(2).standing, (std::vector<FrameSpan>{{50, 99}}));
        QCOMPARE(doings.at(3).standing, (std::vector<FrameSpan>{{0, 99}}));
        const auto hundred = [](TrackId id) {
            TrackSummary track = trackOf(id);
            track.first_frame = 0;
            track.last_frame = 99;
            return track;
        };
        const auto those = [&](TrackCondition condition, std::optional<FrameIndex> now) {
            TrackFilter filter;
            filter.conditions = {condition};
            std::vector<int> ids;
            for (int id = 1; id <= 3; ++id)
                if (filter.holds(hundred(id), kMetres, {.doings = &doings, .now = now})) ids.push_back(id);
            return ids;
        };
        QCOMPARE(those(TrackCondition::moves_now, 20), std::vector<int>{2});
        QCOMPARE(those(TrackCondition::moves_now, 21), (std::vector<int>{1, 2}));
        QCOMPARE(those(TrackCondition::stands_now, 70), (std::vector<int>{1, 2, 3}));
        QCOMPARE(those(TrackCondition::stands_now, 100), std::vector<int>{});
        QCOMPARE(those(TrackCondition::moves_now, std::nullopt).size(), std::size_t(3));
        QCOMPARE(those(TrackCondition::lost, 0), std::vector<int>{2});

        TrackFilter filter;
        filter.conditions = {TrackCondition::corrected};
        TrackSummary track = hundred(1);
        QVERIFY(!filter.holds(track, kMetres, {}));
        track.corrected = CorrectionKind::join;
        QVERIFY(filter.holds(track, kMetres, {}));
        track.corrected = CorrectionKind::reject;
        QVERIFY(!filter.holds(track, kMetres, {}));
        filter.conditions.insert(TrackCondition::rejected);
        QVERIFY(filter.holds(track, kMetres, {}));
        QCOMPARE(chipText(filter, TrackQuality::state, kMetres), QStringLiteral("State corrected, rejected"));
    }

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

    void aFilterIsKeptAsItIs() {
        TrackFilter filter;
        filter.range(TrackQuality::speed) = {12.5, std::nullopt};
        filter.range(TrackQuality::score) = {0.25, 0.75};
        filter.eighths = {0, 7};
        filter.events = {EventKind::lost, EventKind::turns_back};
        filter.zones = {"Höfe", "gate"};
        filter.time = {TimeLimit{120, false}, TimeLimit{79'687, true}};
        filter.conditions = {TrackCondition::moves_now, TrackCondition::rejected};
        QCOMPARE(TrackFilter::fromJson(filter.json()), filter);
        QCOMPARE(TrackFilter::fromJson({}), TrackFilter());
        QCOMPARE(TrackFilter::fromJson({{QStringLiteral("direction"), QStringLiteral("up")}}), TrackFilter());
        QCOMPARE(TrackFilter::fromJson({{QStringLiteral("time"), QStringLiteral("noon")}}), TrackFilter());
    }

    void whatAnOlderVersionKeptIsUnderstood() {
        const QByteArray kept =
            R"({"speed":{"from":20,"to":60.5},"direction":[0,2],"events":["lost"],"zones":["yard"]})";
        const TrackFilter filter = TrackFilter::fromJson(QJsonDocument::fromJson(kept).object());
        QCOMPARE(filter.range(TrackQuality::speed), (TrackRange{20, 60.5}));
        QCOMPARE(filter.eighths, (std::set<int>{0, 2}));
        QCOMPARE(filter.events, std::set<EventKind>{EventKind::lost});
        QCOMPARE(filter.zones, std::set<std::string>{"yard"});
        QVERIFY(!filter.time.any() && filter.conditions.empty());
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

    void aTrackOfOneRunIsNotKeptWithAFilter() {
        TrackFilter filter;
        filter.like = LikeLimit{.track = 12};
        QVERIFY(filter.any());
        QVERIFY(filter.json().isEmpty());
        QVERIFY(!TrackFilter::fromJson({{QStringLiteral("like"), 12}}).any());
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

}  // namespace eyrie::ui::track_filter_test

EYRIE_UI_TEST(QApplication, track_filter_test, TrackFilterTest)
#include "track_filter_test.moc"
