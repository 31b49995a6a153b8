#include <QAction>
#include <QDateTimeEdit>
#include <QPushButton>
#include <QTableView>
#include <QTest>

#include "canvas/timeline/timeline_view.h"
#include "review/bookmarks/bookmarks.h"
#include "review/bookmarks/bookmarks_panel.h"
#include "review/earth/earth_dock.h"
#include "review/earth/start_time_dialog.h"
#include "review/earth/video_earth.h"
#include "review/events/event_review.h"
#include "review/events/events_dock.h"
#include "review/events/events_panel.h"
#include "review/tracks/tracks_panel.h"
#include "store/project/project_file.h"
#include "store/project/video_start.h"
#include "ui/support/ui_test.h"
#include "ui/window/window_with_run.h"
#include "window/docks/review_docks.h"
#include "window/docks/watching_docks.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::start_time_test {

using test::kPatience_ms;

/// When the video was taken, as a person says.
class StartTimeTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static inline const QDateTime kBegin{QDate(2026, 11, 21), QTime(8, 0, 0), Qt::UTC};

    static VideoEarth& earth(MainWindow& window) { return window.watching().earth().earth(); }
    /// The dialog of the command; the test ends where it does not come.
    static StartTimeDialog* ask(MainWindow& window) {
        if (!window.actions().start_time->isEnabled()) return nullptr;
        window.actions().start_time->trigger();
        for (auto* dialog : window.findChildren<StartTimeDialog*>())
            if (dialog->isVisible()) return dialog;
        return nullptr;
    }
    static bool tells(MainWindow& window, const QString& origin) {
        return QTest::qWaitFor([&] { return earth(window).clockOrigin() == origin; }, kPatience_ms);
    }
    static QString shown(const QTableView& table, int row, int column) {
        return table.model()->index(row, column).data().toString();
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void itIsAskedForKeptAndForgotten() {
        {
            const auto window = test::windowWithRun();
            QVERIFY(window);
            StartTimeDialog* dialog = ask(*window);
            QVERIFY(dialog != nullptr);
            QVERIFY(test::says(*dialog, QStringLiteral("It is not known")));
            QVERIFY(!dialog->notKnown().isEnabled());
            dialog->field().setDateTime(kBegin);
            QVERIFY(test::press(*dialog, QStringLiteral("OK")));
            QVERIFY(tells(*window, QStringLiteral("the start time given")));
            QCOMPARE(earth(*window).clockText(25), QStringLiteral("2026-11-21 08:00:01.000 UTC"));
        }
        const auto window = test::windowWithRun();
        QVERIFY(window);
        QVERIFY2(tells(*window, QStringLiteral("the start time given")), "it is kept in the project");
        StartTimeDialog* dialog = ask(*window);
        QVERIFY(dialog != nullptr);
        QCOMPARE(dialog->field().dateTime(), kBegin);
        QVERIFY(test::says(*dialog, QStringLiteral("2026-11-21 08:00:00.000 UTC, by the start time given")));
        QVERIFY(test::press(*dialog, QStringLiteral("Not known")));
        QVERIFY(tells(*window, QString()));
        QCOMPARE(earth(*window).clockText(25), QString());
    }

    void listsAndRulerFollow() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        window->docks().raise(DockId::events);
        const EventReview& review = window->events().review();
        QVERIFY(QTest::qWaitFor([&] { return review.state() == EventReview::State::found; }, kPatience_ms));
        window->events().bookmarks().setAskForNote([](const QString&, FrameIndex) { return QStringLiteral("van"); });
        window->session().goToFrame(25);
        window->actions().bookmark->trigger();
        const QTableView& bookmarks = *window->events().bookmarks().panel().table();
        QTRY_COMPARE_WITH_TIMEOUT(bookmarks.model()->rowCount(), 1, kPatience_ms);
        const QTableView& tracks = *window->review().tracks().table();
        QTRY_VERIFY_WITH_TIMEOUT(tracks.model()->rowCount() > 0, kPatience_ms);
        QCOMPARE(shown(bookmarks, 0, BookmarksModel::time_column), QStringLiteral("0:01.0"));
        QCOMPARE(window->timeline().rulerText(1'000'000), QStringLiteral("0:01"));
        StartTimeDialog* dialog = ask(*window);
        QVERIFY(dialog != nullptr);
        dialog->field().setDateTime(kBegin);
        QVERIFY(test::press(*dialog, QStringLiteral("OK")));
        QVERIFY(tells(*window, QStringLiteral("the start time given")));
        QCOMPARE(shown(bookmarks, 0, BookmarksModel::time_column), QStringLiteral("08:00:01"));
        QCOMPARE(window->timeline().rulerText(1'000'000), QStringLiteral("08:00:01"));
        QVERIFY(shown(tracks, 0, TracksModel::first_column).startsWith(QStringLiteral("08:00:0")));
        EventsModel& events = window->events().model();
        for (int row = 0; row < events.rowCount(); ++row)
            QVERIFY(
                events.index(row, EventsModel::time_column).data().toString().startsWith(QStringLiteral("08:00:0")));
    }

    void whatAnotherProgramSaysIsFollowed() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        QVERIFY(QTest::qWaitFor([&] { return earth(*window).metadata() != nullptr; }, kPatience_ms));
        QVERIFY(tells(*window, QString()));
        ProjectFile other = ProjectFile::open(window->session().project());
        const int video = window->session().runs().back().sequence.id;
        storeVideoStart(other, video, kBegin.toMSecsSinceEpoch() * 1000);
        QVERIFY(tells(*window, QStringLiteral("the start time given")));
        QCOMPARE(earth(*window).clockText(25), QStringLiteral("2026-11-21 08:00:01.000 UTC"));
        QCOMPARE(window->timeline().rulerText(1'000'000), QStringLiteral("08:00:01"));
        storeVideoStart(other, video, std::nullopt);
        QVERIFY(tells(*window, QString()));
    }

    void aTimeOfTheDayLeadsToItsFrame() {
        const auto window = test::windowWithRun();  // of 25 Hz
        QVERIFY(window);
        const auto frameOf = [&](double seconds) { return earth(*window).frameOfDay(seconds, seconds); };
        QVERIFY(!frameOf(8 * 3600));
        StartTimeDialog* dialog = ask(*window);
        QVERIFY(dialog != nullptr);
        dialog->field().setDateTime(kBegin);  // at 08:00:00
        QVERIFY(test::press(*dialog, QStringLiteral("OK")));
        QVERIFY(tells(*window, QStringLiteral("the start time given")));
        QCOMPARE(frameOf(8 * 3600), std::optional(0));
        QCOMPARE(frameOf(8 * 3600 + 1), std::optional(25));
        QCOMPARE(frameOf(8 * 3600 - 60), std::optional(0));
        const int count = static_cast<int>(window->session().timesUs().size());
        QCOMPARE(frameOf(9 * 3600), std::optional(count));
        QCOMPARE(frameOf(23 * 3600), std::optional(0));  // rather of the evening before
        // From 06:00 to 23:00, and from 22:00 to 09:00: what lies between is nearest.
        constexpr double kDay = 14.5 * 3600, kNight = 27.5 * 3600;
        QCOMPARE(earth(*window).frameOfDay(6 * 3600, kDay), std::optional(0));
        QCOMPARE(earth(*window).frameOfDay(23 * 3600, kDay), std::optional(count));
        QCOMPARE(earth(*window).frameOfDay(22 * 3600, kNight), std::optional(0));
        QCOMPARE(earth(*window).frameOfDay(33 * 3600, kNight), std::optional(count));
    }

    void whatIsCancelledChangesNothingAndWithoutAVideoNobodyIsAsked() {
        MainWindow bare;
        QVERIFY(!bare.actions().start_time->isEnabled());
        const auto window = test::windowWithRun();
        QVERIFY(window);
        StartTimeDialog* dialog = ask(*window);
        QVERIFY(dialog != nullptr);
        dialog->field().setDateTime(kBegin);
        QVERIFY(test::press(*dialog, QStringLiteral("Cancel")));
        QVERIFY(!dialog->isVisible());
        QVERIFY(!earth(*window).givenStart());
    }
};

}  // namespace eyrie::ui::start_time_test

EYRIE_UI_TEST(QApplication, start_time_test, StartTimeTest)
#include "start_time_test.moc"
