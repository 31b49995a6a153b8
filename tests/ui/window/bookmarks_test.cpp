#include <QAbstractButton>
#include <QAction>
#include <QLineEdit>
#include <QTableView>
#include <QTest>
#include <utility>

#include "canvas/timeline/timeline_view.h"
#include "review/bookmarks/bookmarks.h"
#include "review/bookmarks/bookmarks_panel.h"
#include "review/events/event_review.h"
#include "review/events/events_dock.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "widgets/empty_state.h"
#include "widgets/message_bar.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::bookmarks_test {

using test::kPatience_ms;

/// Frames that a person marks with a note.
class BookmarksTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    /// The run is made where there is none yet; notes are those of `notes`, one after the other.
    std::unique_ptr<MainWindow> windowWithRun(QStringList notes) {
        auto window = std::make_unique<MainWindow>();
        window->show();
        if (!test::openAndWait(window->session(), test::sceneUnderTest(30))) return nullptr;
        if (window->session().runs().empty() && !test::runAndWait(window->session())) return nullptr;
        window->docks().raise(DockId::events);
        const auto ready = [&] { return window->events().review().state() == EventReview::State::found; };
        if (!QTest::qWaitFor(ready, kPatience_ms)) return nullptr;
        window->events().bookmarks().setAskForNote(
            [notes](const QString&, FrameIndex) mutable -> std::optional<QString> {
                return notes.isEmpty() ? std::nullopt : std::optional(notes.takeFirst());
            });
        return window;
    }
    static void go(MainWindow& window, FrameIndex frame) { window.session().goToFrame(frame); }
    static const std::map<int, Bookmark>& bookmarks(MainWindow& window) { return window.events().review().bookmarks(); }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void aFrameIsMarkedAndStillSoTheNextDay() {
        {
            const auto window = windowWithRun({QStringLiteral("blue van")});
            QVERIFY(window);
            go(*window, 12);
            QVERIFY(!window->actions().remove_bookmark->isEnabled());
            window->actions().bookmark->trigger();
            QCOMPARE(bookmarks(*window).size(), std::size_t(1));
            QVERIFY(window->actions().remove_bookmark->isEnabled());
        }
        const auto window = windowWithRun({});
        QVERIFY(window);
        QCOMPARE(bookmarks(*window).size(), std::size_t(1));
        const Bookmark& bookmark = bookmarks(*window).begin()->second;
        QCOMPARE(bookmark.frame, 12);
        QCOMPARE(bookmark.seconds, 12 / 25.0);
        QCOMPARE(bookmark.note, "blue van");
        QVERIFY(!bookmark.when_utc.empty());
    }

    void bookmarksAreMadeAndTakenBackAlsoBeforeTheTracksAreRead() {
        ProjectSession session;
        QVERIFY(test::openAndWait(session, test::sceneUnderTest(30)) && test::runAndWait(session));
        EventReview* review = nullptr;
        bool marked = false;
        double seconds = -1;
        std::size_t left = 2;
        const auto mark_at_once = [&] {
            if (review == nullptr || !review->canMark() || review->tracks() || std::exchange(marked, true)) return;
            review->setBookmark(4, {});
            review->setBookmark(12, QStringLiteral("blue van"));
            seconds = review->bookmarks().rbegin()->second.seconds;
            review->undo();
            left = review->bookmarks().size();
        };
        const EventReviewAnswers answers{.show_events = [] {},
                                         .show_verdicts = [](const std::vector<std::size_t>&) {},
                                         .show_zones = mark_at_once,
                                         .go_back_to = [](const std::vector<std::size_t>&) {},
                                         .tell_problem = [](const QString&) {},
                                         .tell_notice = [](const QString&) {}};
        EventReview events(session, answers);
        review = &events;
        events.setWanted();
        QVERIFY(QTest::qWaitFor([&] { return events.state() == EventReview::State::found; }, kPatience_ms));
        QVERIFY(marked);
        QCOMPARE(seconds, 12 / 25.0);
        QCOMPARE(left, std::size_t(1));
    }

    void aMarkedFrameHasOneBookmarkWhoseNoteChanges() {
        const auto window = windowWithRun({QStringLiteral("van"), QStringLiteral("lorry")});
        QVERIFY(window);
        go(*window, 5);
        window->actions().bookmark->trigger();
        window->actions().bookmark->trigger();
        window->actions().bookmark->trigger();  // the person cancels
        QCOMPARE(bookmarks(*window).size(), std::size_t(1));
        QCOMPARE(bookmarks(*window).begin()->second.note, "lorry");
        window->actions().undo_verdict->trigger();
        QCOMPARE(bookmarks(*window).begin()->second.note, "van");
    }

    void whatIsRemovedComesBack() {
        const auto window = windowWithRun({QString()});
        QVERIFY(window);
        go(*window, 5);
        window->actions().bookmark->trigger();
        window->actions().remove_bookmark->trigger();
        QVERIFY(bookmarks(*window).empty());
        window->actions().undo_verdict->trigger();
        QCOMPARE(bookmarks(*window).size(), std::size_t(1));
    }

    void oneGoesFromBookmarkToBookmark() {
        const auto window = windowWithRun({QStringLiteral("late"), QStringLiteral("early")});
        QVERIFY(window);
        for (const FrameIndex frame : {20, 4}) {
            go(*window, frame);
            window->actions().bookmark->trigger();
        }
        const WindowActions& actions = window->actions();
        QVERIFY(!actions.previous_bookmark->isEnabled());
        actions.next_bookmark->trigger();
        QCOMPARE(window->session().currentFrame(), 20);
        QVERIFY(!actions.next_bookmark->isEnabled());
        actions.previous_bookmark->trigger();
        QCOMPARE(window->session().currentFrame(), 4);
    }

    void theTimelineShowsThemAndLeadsThere() {
        const auto window = windowWithRun({QStringLiteral("blue van")});
        QVERIFY(window);
        go(*window, 12);
        window->actions().bookmark->trigger();
        go(*window, 0);
        TimelineView& timeline = *window->findChild<TimelineView*>();
        const int mark = -bookmarks(*window).begin()->first;
        QVERIFY(QTest::qWaitFor([&] { return timeline.placeOfMark(mark).has_value(); }, kPatience_ms));
        QVERIFY(window->events().bookmarks().markText(mark).contains(QStringLiteral("blue van")));
        QTest::mouseClick(&timeline, Qt::LeftButton, {}, timeline.placeOfMark(mark)->toPoint());
        QCOMPARE(window->session().currentFrame(), 12);
    }

    void theListLeadsThereChangesNotesAndRemoves() {
        const auto window = windowWithRun({QStringLiteral("late"), QStringLiteral("early")});
        QVERIFY(window);
        window->docks().raise(DockId::bookmarks);
        BookmarksPanel& panel = window->events().bookmarks().panel();
        QVERIFY(panel.isVisible());
        const QAbstractItemModel& list = *panel.table()->model();
        QCOMPARE(list.rowCount(), 0);
        QVERIFY(panel.emptyState()->isVisible());
        QVERIFY(panel.emptyState()->explanation().contains(QStringLiteral("Ctrl+F9 marks the frame that is shown")));
        go(*window, 20);
        panel.emptyState()->button()->click();
        go(*window, 4);
        window->actions().bookmark->trigger();
        const auto shown = [&](int row, int column) { return list.index(row, column).data().toString(); };
        QCOMPARE(list.rowCount(), 2);
        QCOMPARE(shown(0, BookmarksModel::note_column), QStringLiteral("early"));
        QCOMPARE(shown(1, BookmarksModel::frame_column), QStringLiteral("20"));
        QCOMPARE(shown(1, BookmarksModel::time_column), QStringLiteral("0:00.8"));
        QVERIFY(!shown(1, BookmarksModel::made_column).isEmpty());
        const QPoint second = panel.table()->visualRect(list.index(1, BookmarksModel::note_column)).center();
        QTest::mouseClick(panel.table()->viewport(), Qt::LeftButton, {}, second);
        QTest::mouseDClick(panel.table()->viewport(), Qt::LeftButton, {}, second);
        QCOMPARE(window->session().currentFrame(), 20);
        // F2 writes another note in place.
        QTest::keyClick(panel.table(), Qt::Key_F2);
        auto* line = panel.table()->findChild<QLineEdit*>();
        QVERIFY(line != nullptr);
        line->selectAll();
        QTest::keyClicks(line, QStringLiteral("a lorry"));
        QTest::keyClick(line, Qt::Key_Return);
        QTRY_COMPARE(shown(1, BookmarksModel::note_column), QStringLiteral("a lorry"));
        QTest::keyClick(panel.table(), Qt::Key_Delete);
        QCOMPARE(bookmarks(*window).size(), std::size_t(1));
        QCOMPARE(bookmarks(*window).begin()->second.note, "early");
        QCOMPARE(list.rowCount(), 1);
        window->actions().undo_verdict->trigger();
        QCOMPARE(list.rowCount(), 2);
    }

    void withoutARunTheListSaysWhatItNeeds() {
        MainWindow window;
        window.show();
        QVERIFY(test::openAndWait(window.session(), test::sceneUnderTest(5)));
        window.docks().raise(DockId::bookmarks);
        const BookmarksPanel& panel = window.events().bookmarks().panel();
        QVERIFY(panel.emptyState()->explanation().contains(QStringLiteral("the video needs a run first")));
        QVERIFY(!panel.emptyState()->button()->isVisible());
    }

    void labellingHasOtherKeys() {
        const auto window = windowWithRun({});
        QVERIFY(window);
        QVERIFY(window->actions().bookmark->isEnabled());
        window->actions().workspaceAction(WorkspaceKind::label)->trigger();
        QVERIFY(!window->actions().bookmark->isEnabled());
    }
};

}  // namespace eyrie::ui::bookmarks_test

EYRIE_UI_TEST(QApplication, bookmarks_test, BookmarksTest)
#include "bookmarks_test.moc"
