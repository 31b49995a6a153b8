#include <atomic>
#include <fstream>

#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::session_test {

using test::kPatience_ms;
using test::openAndWait;
using test::runAndWait;
using test::shows;

class SessionTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void opensAVideoShowsItsFirstFrameAndMakesItsProject() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(30)));
        QCOMPARE(session.video()->frame_count, 30);
        QCOMPARE(session.settings().gsd_m_per_px, 0.25);
        QVERIFY(shows(session, 0));
        QVERIFY(std::filesystem::exists(session.project()));
        QVERIFY(session.runs().empty());
        session.goToFrame(12);
        QVERIFY(shows(session, 12));
        session.goToFrame(1000);
        QCOMPARE(session.currentFrame(), 29);
    }

    void theWindowThreadNeverReadsPicturesOrResults() {
        std::atomic<bool> on_window_thread = false;
        std::atomic<bool> read = false;
        const auto window_thread = std::this_thread::get_id();
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(60, [&](FrameIndex) {
                                read = true;
                                if (std::this_thread::get_id() == window_thread) on_window_thread = true;
                            })));
        QVERIFY(runAndWait(session));
        session.playback().setSpeed(8, 0);
        session.goToFrame(0);
        QSignalSpy playing(&session.playback(), &Playback::playingChanged);
        session.togglePlay();
        QVERIFY(QTest::qWaitFor([&] { return playing.count() >= 2; }, kPatience_ms));
        QVERIFY(read && !on_window_thread);
    }

    void playingEndsAtTheLastFrameAndLoopsWhenAsked() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(10)));
        session.playback().setSpeed(8, 0);
        session.togglePlay();
        QVERIFY(QTest::qWaitFor([&] { return !session.playback().playing(); }, kPatience_ms));
        QCOMPARE(session.currentFrame(), 9);
        session.playback().setLooping(true);
        int wraps = 0;
        FrameIndex before = 9;
        connect(&session, &ProjectSession::changed, this, [&](SessionChange change) {
            if (change != SessionChange::frame) return;
            const FrameIndex frame = session.currentFrame();
            if (frame < before) ++wraps;
            before = frame;
        });
        session.togglePlay();
        QVERIFY(QTest::qWaitFor([&] { return wraps >= 3; }, kPatience_ms));
        session.shuttle(0);
        QVERIFY(!session.playback().playing());
    }

    void shuttleKeysDoubleTheSpeedAndTurnAround() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(500)));
        session.shuttle(1);
        QCOMPARE(session.playback().speed(), 1.0);
        session.shuttle(1);
        QCOMPARE(session.playback().speed(), 2.0);
        session.shuttle(-1);
        QCOMPARE(session.playback().speed(), -1.0);
        for (int i = 0; i < 9; ++i) session.shuttle(-1);
        QCOMPARE(session.playback().speed(), -Playback::kFastest);
        session.shuttle(0);
        QVERIFY(!session.playback().playing());
    }

    void aMissingVideoIsToldAndLeavesTheFormerOneOpen() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(10)));
        QSignalSpy problem(&session, &ProjectSession::problem);
        session.open(*home_ / "no-such-clip.mp4");
        QVERIFY(problem.wait(kPatience_ms));
        QVERIFY(problem.at(0).at(0).toString().contains(QStringLiteral("no-such-clip.mp4")));
        QCOMPARE(session.video()->frame_count, 10);
        session.goToFrame(4);
        QVERIFY(shows(session, 4));
    }

    void aForeignProjectIsRefused() {
        const auto path = *home_ / "foreign.eyrie";
        std::ofstream(path) << "this is a letter, not a project";
        ProjectSession session;
        QSignalSpy problem(&session, &ProjectSession::problem);
        session.open(path);
        QVERIFY(problem.wait(kPatience_ms));
        QVERIFY(problem.at(0).at(0).toString().contains(QStringLiteral("foreign.eyrie")));
        QVERIFY(!session.video());
    }

    void aProjectWhoseVideoIsGoneStillShowsItsResults() {
        std::filesystem::path project;
        {
            ProjectSession session;
            QVERIFY(openAndWait(session, test::sceneUnderTest(30)));  // its identity names no file
            QVERIFY(runAndWait(session));
            project = session.project();
        }
        ProjectSession session;
        QSignalSpy not_found(&session, &ProjectSession::videoNotFound);
        QSignalSpy ready(&session, &ProjectSession::ready);
        session.open(project);
        QVERIFY(ready.wait(kPatience_ms));
        QCOMPARE(not_found.count(), 1);
        QVERIFY(session.videoMissing());
        QCOMPARE(session.video()->frame_count, 30);
        QCOMPARE(session.settings().gsd_m_per_px, 0.25);  // what the run was given; a next one gets it too
        session.goToFrame(20);
        QVERIFY(QTest::qWaitFor([&] { return session.viewFrame().index == 20 && session.viewFrame().result; },
                                kPatience_ms));
        QVERIFY(session.viewFrame().image.isNull());
    }

    void anUnwritableProjectIsToldAndTheVideoStillPlays() {
        const auto blocker = *home_ / "data";  // a file where the folder should be
        std::ofstream(blocker) << "x";
        ProjectSession session;
        QSignalSpy problem(&session, &ProjectSession::problem);
        session.openMedia(test::sceneUnderTest(10));
        QVERIFY(problem.wait(kPatience_ms));
        QVERIFY(shows(session, 0));
        session.startRun();
        QVERIFY(!session.running());
        QCOMPARE(problem.count(), 2);
    }
};

}  // namespace eyrie::ui::session_test

EYRIE_UI_TEST(QCoreApplication, session_test, SessionTest)
#include "session_test.moc"
