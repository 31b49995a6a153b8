#include <QAction>
#include <QTest>

#include "canvas/timeline/timeline_view.h"
#include "review/bookmarks/bookmarks.h"
#include "review/events/event_review.h"
#include "review/events/events_dock.h"
#include "ui/session/session_support.h"
#include "widgets/message_bar.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

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

    void labellingHasOtherKeys() {
        const auto window = windowWithRun({});
        QVERIFY(window);
        QVERIFY(window->actions().bookmark->isEnabled());
        window->actions().workspaceAction(WorkspaceKind::label)->trigger();
        QVERIFY(!window->actions().bookmark->isEnabled());
    }
};

}  // namespace eyrie::ui

QTEST_MAIN(eyrie::ui::BookmarksTest)
#include "bookmarks_test.moc"
