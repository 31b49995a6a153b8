#include "label/computing/label_tracking.h"

#include <QScopeGuard>
#include <atomic>
#include <memory>

#include "label/editor/label_editor.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::label_tracking_test {

using test::kPatience_ms;

/// Boxes that are followed in the background while the window goes on.
class LabelTrackingTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kPatience_ms); }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void whatWasFollowedInOneVideoIsNotTakenOverInAnother() {
        test::Door door;
        ProjectSession session;
        LabelSession labels(session);
        LabelEditor editor(session, labels);
        int ended = 0;
        LabelTracking tracking(session, labels,
                               {.working_changed = [] {},
                                .show_advance = [](const TrackingAdvance&) {},
                                .show_end = [&](FrameIndex, const QString&) { ++ended; }});
        const auto at_last = qScopeGuard([&door] { door.open(); });  // whoever waits there holds up the rest
        labels.setWanted(true);
        // The window's own pictures are there at once; who opens the video later waits at the door.
        Media first = test::sceneUnderTest(12);
        const auto opened = std::make_shared<std::atomic<int>>(0);
        first.open = [&door, opened](const IndexProgress&, std::stop_token) -> std::unique_ptr<FrameSource> {
            if (opened->fetch_add(1) == 0) return std::make_unique<test::SceneSource>(12, nullptr);
            return std::make_unique<test::SceneSource>(12, [&door](FrameIndex frame) { door.pass(frame); });
        };
        QVERIFY(test::openAndWait(session, first) && test::shows(session, 0));
        QVERIFY(waitFor([&] { return labels.isOpen(); }));
        const OrientedBox box{{31, 55}, 22, 11, 0};
        const auto id = editor.add(box, 0);
        QVERIFY(id);
        door.closeFrom(5);
        tracking.start(1);
        QVERIFY(waitFor([&] { return door.reached() >= 5; }));

        Media second = test::sceneUnderTest(12);
        second.name = "other.mp4";
        second.identity = "/nowhere/other.mp4";
        const bool other = test::openAndWait(session, second) && waitFor([&] { return labels.isOpen(); });
        const auto other_id = editor.add(box, 0);
        door.open();
        QVERIFY(waitFor([&] { return !tracking.working(); }));
        QVERIFY(other && other_id);
        QCOMPARE(*other_id, *id);  // numbers begin anew in every project
        QCOMPARE(labels.object(*other_id)->keyframes.size(), std::size_t(1));
        QCOMPARE(ended, 0);  // nor does this video go to a frame of that one
    }

    void whatIsSureWhenThePersonLeavesIsWaitedForAndKept() {
        test::Door door;
        ProjectSession session;
        LabelSession labels(session);
        LabelEditor editor(session, labels);
        LabelTracking tracking(session, labels,
                               {.working_changed = [] {},
                                .show_advance = [](const TrackingAdvance&) {},
                                .show_end = [](FrameIndex, const QString&) {}});
        const auto at_last = qScopeGuard([&door] { door.open(); });  // whoever waits there holds up the rest
        labels.setWanted(true);
        Media media = test::sceneUnderTest(12);
        const auto opened = std::make_shared<std::atomic<int>>(0);
        media.open = [&door, opened](const IndexProgress&, std::stop_token) -> std::unique_ptr<FrameSource> {
            if (opened->fetch_add(1) == 0) return std::make_unique<test::SceneSource>(12, nullptr);
            return std::make_unique<test::SceneSource>(12, [&door](FrameIndex frame) { door.pass(frame); });
        };
        QVERIFY(test::openAndWait(session, media) && test::shows(session, 0));
        QVERIFY(waitFor([&] { return labels.isOpen(); }));
        const auto id = editor.add({{31, 55}, 22, 11, 0}, 0);
        QVERIFY(id);
        door.closeFrom(5);
        tracking.start(1);
        QVERIFY(waitFor([&] { return door.reached() >= 5; }));

        WrittenWait wait;
        wait.watch();
        session.endWork();  // as before the window closes
        QVERIFY(wait.anythingDue());
        std::size_t keyframes_then = 0;
        wait.begin([&](bool) { keyframes_then = labels.object(*id)->keyframes.size(); });
        door.open();
        QVERIFY(waitFor([&] { return !wait.waiting(); }));
        QVERIFY(!wait.anythingFailed());
        QVERIFY2(keyframes_then > 1, "who waits finds in the labels what was sure");
        QVERIFY2(door.reached() < 11, "it went no further");
    }

    void trackingGoesOnWhileThePersonStays() {
        test::Door door;
        ProjectSession session;
        LabelSession labels(session);
        LabelEditor editor(session, labels);
        QString told;
        LabelTracking tracking(session, labels,
                               {.working_changed = [] {},
                                .show_advance = [](const TrackingAdvance&) {},
                                .show_end = [&](FrameIndex, const QString& text) { told = text; }});
        const auto at_last = qScopeGuard([&door] { door.open(); });  // whoever waits there holds up the rest
        labels.setWanted(true);
        Media media = test::sceneUnderTest(12);
        const auto opened = std::make_shared<std::atomic<int>>(0);
        media.open = [&door, opened](const IndexProgress&, std::stop_token) -> std::unique_ptr<FrameSource> {
            if (opened->fetch_add(1) == 0) return std::make_unique<test::SceneSource>(12, nullptr);
            return std::make_unique<test::SceneSource>(12, [&door](FrameIndex frame) { door.pass(frame); });
        };
        QVERIFY(test::openAndWait(session, media) && test::shows(session, 0));
        QVERIFY(waitFor([&] { return labels.isOpen(); }));
        QVERIFY(editor.add({{31, 55}, 22, 11, 0}, 0));
        door.closeFrom(5);
        tracking.start(1);
        QVERIFY(waitFor([&] { return door.reached() >= 5; }));
        session.keepWritten();  // as before a run begins, or a copy is saved
        door.open();
        QVERIFY(waitFor([&] { return !tracking.working(); }));
        QVERIFY2(!told.contains(QStringLiteral("by hand")), qPrintable(told));
    }
};

}  // namespace eyrie::ui::label_tracking_test

EYRIE_UI_TEST(QApplication, label_tracking_test, LabelTrackingTest)
#include "label_tracking_test.moc"
