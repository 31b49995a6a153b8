#include "review/tracks/track_filter.h"

#include <QJsonDocument>
#include <QJsonObject>
#include <QTest>
#include <numbers>

#include "ui/review/filtered_tracks.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::track_filter_test {

using test::happening;
using test::kMetres;
using test::threeDriven;
using test::trackOf;

namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

/// Which tracks a filter holds, how it is told, and how it is kept.
class TrackFilterTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

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

    void aTrackOfOneRunIsNotKeptWithAFilter() {
        TrackFilter filter;
        filter.like = LikeLimit{.track = 12};
        QVERIFY(filter.any());
        QVERIFY(filter.json().isEmpty());
        QVERIFY(!TrackFilter::fromJson({{QStringLiteral("like"), 12}}).any());
    }
};

}  // namespace eyrie::ui::track_filter_test

EYRIE_UI_TEST(QApplication, track_filter_test, TrackFilterTest)
#include "track_filter_test.moc"
