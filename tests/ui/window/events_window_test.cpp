#include <QApplication>
#include <QDockWidget>
#include <QFile>
#include <QMenu>
#include <QPushButton>
#include <QTableView>
#include <QTest>
#include <QTimer>
#include <algorithm>

#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "label/label_workspace.h"
#include "review/events/event_review.h"
#include "review/events/event_thresholds.h"
#include "review/events/events_dock.h"
#include "review/events/events_panel.h"
#include "review/pictures/picture_column.h"
#include "review/tracks/tracks_panel.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "ui/window/window_with_run.h"
#include "widgets/message_bar.h"
#include "window/docks/event_report.h"
#include "window/main_window.h"
#include "window/run_messages.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::events_window_test {

using test::kPatience_ms;

/// The dock of events among the others of the window.
class EventsWindowTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static std::unique_ptr<MainWindow> windowWithEvents() {
        auto window = test::windowWithRun();
        if (!window) return nullptr;
        window->messages().setMaximumHeight(0);  // notices pass
        EventThresholds& limits = window->events().panel().thresholds();
        limits.setValue(QStringLiteral("events.over"), QStringLiteral("5"));
        limits.setValue(QStringLiteral("events.over_time"), QStringLiteral("0.2"));
        window->docks().raise(DockId::events);
        const auto found = [&] { return window->events().model().rowCount() >= 2; };
        return QTest::qWaitFor(found, kPatience_ms) ? std::move(window) : nullptr;
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void labellingHasItsOwnKeysAndNoMarks() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        QVERIFY(window->actions().relevant->isEnabled());
        QTest::keyClick(window.get(), Qt::Key_2, Qt::ControlModifier);
        QVERIFY(window->labelling().active());
        QVERIFY(window->timeline().marks().empty());
        QVERIFY(!window->actions().relevant->isEnabled());
        QTest::keyClick(window.get(), Qt::Key_1, Qt::ControlModifier);
        QVERIFY(window->actions().relevant->isEnabled());
        QVERIFY(!window->timeline().marks().empty());
    }

    void whatIsAskedForOfNoEventIsSaidToNeedOne() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        const WindowActions& actions = window->actions();
        const QString told = QStringLiteral("Select an event first.");
        for (QAction* action : {actions.star, actions.take_back, actions.note}) {
            window->events().panel().table()->clearSelection();
            window->messages().dismissAll();
            QVERIFY(action->isEnabled());
            action->trigger();
            QVERIFY2(window->messages().texts().contains(told), qPrintable(action->text()));
        }
    }

    void marksOnTheTimelineAreThoseThatTheFilterLineLeaves() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        EventsPanel& panel = window->events().panel();
        const auto marks = [&] { return static_cast<int>(window->timeline().marks().size()); };
        const auto all = [&] { return window->events().model().rowCount(); };
        const auto left = [&] { return panel.table()->model()->rowCount(); };
        QTRY_VERIFY_WITH_TIMEOUT(marks() == all(), kPatience_ms);
        panel.setFilterText(QStringLiteral("over speed"));
        QTRY_VERIFY_WITH_TIMEOUT(left() > 0 && left() < all() && marks() == left(), kPatience_ms);
        panel.setFilterText(QStringLiteral("no event has this"));
        QTRY_COMPARE_WITH_TIMEOUT(marks(), 0, kPatience_ms);
        panel.setFilterText(QString());
        QTRY_VERIFY_WITH_TIMEOUT(marks() == all(), kPatience_ms);
    }

    void listsOfEventsAndTracksShowTheirVehicles() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        EventsPanel& events = window->events().panel();
        auto* of_events = events.findChild<PictureColumn*>();
        events.table()->showColumn(EventsModel::picture_column);
        const EventEntry* entry = nullptr;
        for (int row = 0; entry == nullptr; ++row) {
            entry = window->events().model().recordAt(row);
            QVERIFY(entry != nullptr);
            if (window->events().model().found()->eventAt(entry->position) == nullptr) entry = nullptr;
        }
        const int id = entry->id;
        events.selectId(id);
        QTRY_VERIFY_WITH_TIMEOUT(of_events->pictureOf(id) != nullptr, kPatience_ms);
        QVERIFY(!of_events->pictureOf(id)->isNull());

        auto* tracks = window->findChild<TracksPanel*>();
        auto* of_tracks = tracks->findChild<PictureColumn*>();
        window->docks().raise(DockId::tracks);
        tracks->table()->showColumn(TracksModel::picture_column);
        const int track = window->events().review().tracks()->tracks.front().id;
        QVERIFY2(of_tracks->pictureOf(track) == nullptr, "nobody looked at it yet");
        tracks->selectId(track);
        QTRY_VERIFY_WITH_TIMEOUT(of_tracks->pictureOf(track) != nullptr, kPatience_ms);
        QVERIFY(!of_tracks->pictureOf(track)->isNull());
    }

    void rowsOfKindsAreFoldedByACommandAndThatIsKept() {
        {
            const auto window = windowWithEvents();
            QVERIFY(window);
            QTRY_VERIFY_WITH_TIMEOUT(!window->timeline().kinds().empty(), kPatience_ms);
            QVERIFY(window->timeline().kindsShown() && window->actions().event_rows->isChecked());
            emit window->timeline().kindsShownWanted(false);
            QVERIFY(!window->timeline().kindsShown() && !window->actions().event_rows->isChecked());
            window->close();
        }
        MainWindow window;
        QVERIFY(!window.timeline().kindsShown());
        window.actions().event_rows->setChecked(true);
        QVERIFY(window.timeline().kindsShown());
    }

    void theSearchAreaOfATrackIsDrawnOnlyWhereADockExplainsIt() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        const auto open = [&](WorkspaceKind kind) { window->actions().workspaceAction(kind)->trigger(); };
        const auto drawn = [&] { return window->canvas().inspectedArea().has_value(); };
        open(WorkspaceKind::tune);
        QVERIFY(QTest::qWaitFor(
            [&] { return window->session().runData() && !window->session().runData()->tracks.empty(); }, kPatience_ms));
        const std::vector<TrackSummary> tracks = window->session().runData()->tracks;
        for (const TrackSummary& track : tracks) {
            window->session().selectTrack(track.id);
            window->session().goToFrame((track.first_frame + track.last_frame) / 2);
            if (QTest::qWaitFor(drawn, 1000)) break;
        }
        QVERIFY(drawn());
        open(WorkspaceKind::review);
        QVERIFY2(!drawn(), "operators are not told what it means");
        open(WorkspaceKind::tune);
        QVERIFY(drawn());
    }

    void theReportIsACommandToo() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        const QAction* report = window->actions().report_events;
        QVERIFY(report->isEnabled());
        window->docks().raise(DockId::tracks);
        QStringList offered;
        bool one_is_chosen = false;
        QTimer::singleShot(0, window.get(), [&] {
            auto* choices = qobject_cast<QMenu*>(QApplication::activePopupWidget());
            if (choices == nullptr) return;
            for (const QAction* choice : choices->actions()) offered << choice->text();
            one_is_chosen = choices->activeAction() != nullptr;
            choices->close();
        });
        window->actions().report_events->trigger();
        QCOMPARE(offered.size(), 3);
        QVERIFY2(one_is_chosen, "by the key alone");
        QVERIFY(window->events().panel().isVisible());
    }

    void reportsAreWrittenOrSayWhyNot() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        const auto at = [this](const char* name) { return QString::fromStdString((*home_ / name).string()); };
        const auto told = [&](const QString& words) {
            const auto said = [&] {
                const QStringList texts = window->messages().texts();
                return std::any_of(texts.begin(), texts.end(),
                                   [&](const QString& text) { return text.contains(words); });
            };
            return QTest::qWaitFor(said, kPatience_ms);
        };
        window->eventReport().write(at("all.html").toStdString(), ReportedEvents::all);
        QVERIFY(told(tr("Wrote the report %1.").arg(at("all.html"))));
        QFile html(at("all.html"));
        QVERIFY(html.open(QIODevice::ReadOnly));
        const QByteArray page = html.readAll();
        QVERIFY(page.contains("over speed") && page.contains("data:image/jpeg;base64"));
        QVERIFY2(page.contains("events.over_time"), "limits that are set in the dock");
        window->eventReport().write(at("judged.pdf").toStdString(), ReportedEvents::judged);
        QVERIFY(told(tr("Wrote the report %1.").arg(at("judged.pdf"))));
        QFile pdf(at("judged.pdf"));
        QVERIFY(pdf.open(QIODevice::ReadOnly));
        QVERIFY(pdf.read(5) == "%PDF-");
        EventsPanel& panel = window->events().panel();
        const std::vector<int> numbers = panel.listedNumbers();
        QVERIFY(numbers.size() >= 2);
        panel.kinds().showAll(false);
        panel.kinds().setShown(static_cast<int>(EventKind::over_speed), true);
        QVERIFY(!panel.listedNumbers().empty() && panel.listedNumbers().size() < numbers.size());
        window->eventReport().write(at("listed.html").toStdString(), ReportedEvents::listed);
        QVERIFY(told(tr("Wrote the report %1.").arg(at("listed.html"))));
        QFile listed(at("listed.html"));
        QVERIFY(listed.open(QIODevice::ReadOnly));
        const QByteArray part = listed.readAll();
        QCOMPARE(part.count("<h3>"), panel.listedNumbers().size());
        QVERIFY(part.contains("over speed") && !part.contains(". appears"));
        window->eventReport().write(at("stopped.html").toStdString(), ReportedEvents::all);
        const auto buttons = window->messages().findChildren<QPushButton*>();
        const auto cancel = std::find_if(buttons.begin(), buttons.end(),
                                         [](const QPushButton* button) { return button->text() == tr("Cancel"); });
        QVERIFY(cancel != buttons.end());
        (*cancel)->click();
        QVERIFY(told(tr("The report was stopped")));
        QVERIFY(!QFile::exists(at("stopped.html")));
        window->eventReport().write(at("no/where/r.html").toStdString(), ReportedEvents::all);
        QVERIFY(told(QStringLiteral("no/where")));
    }

    void theEndOfARunLeadsToItsEvents() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        const auto button = [&](const QString& text) -> QPushButton* {
            for (auto* each : window->messages().findChildren<QPushButton*>())
                if (each->text() == text) return each;
            return nullptr;
        };
        window->messages().dismissAll();
        RunFacts facts;
        facts.counts.frames = 60;
        facts.counts.tracks = 2;
        const RunRecord run = *window->session().shownRun();
        emit window->session().runSummarised(run, facts);
        const auto found = window->events().review().found()->events.size();
        QVERIFY2(window->messages().texts().front().contains(QStringLiteral("2 tracks, %1 events").arg(found)),
                 qPrintable(window->messages().texts().front()));
        window->docks().raise(DockId::tracks);
        QTRY_VERIFY(window->docks().dock(DockId::events)->visibleRegion().isEmpty());
        QVERIFY(button(tr("Review the events")) != nullptr);
        button(tr("Review the events"))->click();
        QTRY_VERIFY(!window->docks().dock(DockId::events)->visibleRegion().isEmpty());
        // Found later, they are told as long as the message is there.
        auto* messages = window->findChild<RunMessages*>();
        emit window->session().runSummarised(run, facts);
        messages->tellEvents(run.id, 0);
        QVERIFY(button(tr("Show the tracks")) != nullptr);
        messages->tellEvents(run.id, 7);
        QVERIFY(window->messages().texts().front().contains(QStringLiteral("2 tracks, 7 events")));
        window->messages().dismissAll();
        messages->tellEvents(run.id, 8);
        QVERIFY(window->messages().texts().isEmpty());
    }

    void escapeShowsTheWholeTimelineWhenNothingIsSelected() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        window->events().show(window->events().model().recordAt(0)->id);
        QVERIFY(window->session().selectedTrack());
        window->timeline().showAround(10, 20, 0);
        const TimelineAxis& axis = window->timeline().axis();
        window->canvas().setFocus();
        QTest::keyClick(window.get(), Qt::Key_Escape);
        QVERIFY(!window->session().selectedTrack());
        QVERIFY(!axis.showsAll());
        QTest::keyClick(window.get(), Qt::Key_Escape);
        QVERIFY(axis.showsAll());
    }

    void theVideoKeepsHalfOfASmallWindow() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        for (const Qt::Key key : {Qt::Key_1, Qt::Key_3}) {
            QTest::keyClick(window.get(), key, Qt::ControlModifier);
            QTest::qWait(0);
            QCOMPARE(window->size(), QSize(1280, 720));
            QVERIFY2(
                window->canvas().width() >= 640 && window->canvas().height() >= 360,
                qPrintable(QStringLiteral("%1 x %2").arg(window->canvas().width()).arg(window->canvas().height())));
        }
    }
};

}  // namespace eyrie::ui::events_window_test

EYRIE_UI_TEST(QApplication, events_window_test, EventsWindowTest)
#include "events_window_test.moc"
