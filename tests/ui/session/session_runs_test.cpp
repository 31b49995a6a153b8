#include "core/error.h"
#include "store/runs/result_writer.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::session_runs_test {

using test::Door;
using test::kPatience_ms;
using test::openAndWait;
using test::runAndWait;
using test::shows;

class SessionRunsTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void aRunFindsTracksAndIsThereWhenTheVideoIsOpenedAgain() {
        {
            ProjectSession session;
            QVERIFY(openAndWait(session, test::sceneUnderTest(40)));
            QSignalSpy live(&session, &ProjectSession::liveFrames);
            QVERIFY(runAndWait(session));
            QCOMPARE(session.runs().size(), std::size_t(1));
            QVERIFY(live.count() >= 1);
        }
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(40)));
        QVERIFY(session.currentRun());
        QVERIFY(QTest::qWaitFor([&] { return session.runData() != nullptr; }, kPatience_ms));
        QCOMPARE(session.runs().back().state, RunState::finished);
        QCOMPARE(session.runData()->frames.size(), std::size_t(40));
        session.goToFrame(30);
        QVERIFY(QTest::qWaitFor([&] { return session.viewFrame().index == 30 && session.viewFrame().result; },
                                kPatience_ms));
        QCOMPARE(session.viewFrame().result->motion.frame, 30);
        QVERIFY(!session.viewFrame().image.isNull());
    }

    void liveAndStoredFramesAreTheSame() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(25)));
        std::optional<ViewFrame> live;
        connect(&session, &ProjectSession::changed, this, [&](SessionChange change) {
            const ViewFrame& frame = session.viewFrame();
            if (change == SessionChange::picture && session.following() && frame.result) live = frame;
        });
        QVERIFY(runAndWait(session));
        QVERIFY(live);
        session.goToFrame(live->index);
        QVERIFY(QTest::qWaitFor(
            [&] {
                return session.viewFrame().index == live->index && session.viewFrame().result &&
                       session.viewFrame().result != live->result;
            },
            kPatience_ms));
        const FrameResult& stored = *session.viewFrame().result;
        QCOMPARE(stored.motion.motion_vectors.size(), live->result->motion.motion_vectors.size());
        QCOMPARE(stored.clusters.size(), live->result->clusters.size());
        QCOMPARE(stored.detections.size(), live->result->detections.size());
        QCOMPARE(session.viewFrame().image, live->image);
        QVERIFY(live->scale.gsd_known);
        QCOMPARE(session.viewFrame().scale.gsd_m_per_px, live->scale.gsd_m_per_px);
        QCOMPARE(session.viewFrame().scale.gsd_known, live->scale.gsd_known);
    }

    void stoppingKeepsWhatIsDone() {
        auto door = std::make_shared<Door>();
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(200, [door](FrameIndex f) { door->pass(f); })));
        session.settings().options.view.oblique = false;  // which reads elsewhere, too
        door->closeFrom(20);
        QSignalSpy finished(&session, &ProjectSession::runFinished);
        session.startRun();
        QVERIFY(QTest::qWaitFor([&] { return !session.runs().empty() && session.runs().back().frames_done >= 10; },
                                kPatience_ms));
        session.stopRun();
        door->open();
        QVERIFY(finished.wait(kPatience_ms));
        QCOMPARE(finished.at(0).at(0).value<RunSummary>().outcome, RunOutcome::stopped);
        QVERIFY(QTest::qWaitFor([&] { return session.runs().back().state == RunState::stopped; }, kPatience_ms));
        const int kept = session.runs().back().frames_done;
        QVERIFY(kept >= 10 && kept < 200);
        session.goToFrame(kept - 1);
        QVERIFY(QTest::qWaitFor([&] { return session.viewFrame().index == kept - 1 && session.viewFrame().result; },
                                kPatience_ms));
    }

    void closingDuringARunKeepsWhatIsDone() {
        auto door = std::make_shared<Door>();
        std::filesystem::path project;
        {
            ProjectSession session;
            QVERIFY(openAndWait(session, test::sceneUnderTest(500, [door](FrameIndex f) { door->pass(f); })));
            project = session.project();
            session.settings().options.view.oblique = false;  // which reads elsewhere, too
            door->closeFrom(30);
            session.startRun();
            QVERIFY(QTest::qWaitFor([&] { return !session.runs().empty() && session.runs().back().frames_done >= 15; },
                                    kPatience_ms));
            session.stopRun();
            door->open();
        }  // waits for the frame at work only: 470 frames were never read
        QVERIFY(door->reached() < 60);
        ProjectFile file = ProjectFile::open(project);
        const auto runs = RunStore(file).runs();
        QCOMPARE(runs.size(), std::size_t(1));
        QVERIFY(runs[0].frames_done >= 15);
        QCOMPARE(runs[0].state, RunState::stopped);
    }

    void duringARunEarlierFramesCanBeSeenAndTheRunFollowedAgain() {
        auto door = std::make_shared<Door>();
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(120, [door](FrameIndex f) { door->pass(f); })));
        session.settings().options.view.oblique = false;  // which reads elsewhere, too
        door->closeFrom(40);
        session.startRun();
        QVERIFY(session.following());
        QVERIFY(QTest::qWaitFor([&] { return !session.runs().empty() && session.runs().back().frames_done >= 30; },
                                kPatience_ms));
        session.goToFrame(5);
        QVERIFY(!session.following());
        QVERIFY(shows(session, 5));
        QCOMPARE(session.currentFrame(), 5);
        door->open();
        session.follow();
        QVERIFY(QTest::qWaitFor([&] { return !session.running(); }, kPatience_ms));
        QCOMPARE(session.currentFrame(), 119);
    }

    void aRunThatCannotReadItsVideoFailsWithAMessage() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(40, [](FrameIndex f) {
                                if (f == 25) throw Error(ErrorKind::input, "clip.mp4: frame 25 is damaged");
                            })));
        QSignalSpy problem(&session, &ProjectSession::problem);
        QVERIFY(runAndWait(session));
        QVERIFY(!problem.isEmpty());
        QVERIFY(problem.at(0).at(0).toString().contains(QStringLiteral("frame 25 is damaged")));
        QVERIFY(QTest::qWaitFor([&] { return session.runs().back().state == RunState::failed; }, kPatience_ms));
        QVERIFY(session.runs().back().frames_done > 0);
    }

    void aRangeOfFramesIsProcessed() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(60)));
        session.settings().range = {10, 29};
        QVERIFY(runAndWait(session));
        QVERIFY(
            QTest::qWaitFor([&] { return session.runData() && session.runData()->frames.size() == 20; }, kPatience_ms));
        QCOMPARE(session.runData()->frames.front().frame, 10);
    }

    void runsAreRenamedAndRemoved() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(15)));
        QVERIFY(runAndWait(session));
        QVERIFY(runAndWait(session));
        QCOMPARE(session.runs().size(), std::size_t(2));
        session.renameRun(session.runs()[0].id, QStringLiteral("first try"));
        QVERIFY(QTest::qWaitFor([&] { return session.runs()[0].name == "first try"; }, kPatience_ms));
        const int removed = session.runs()[1].id;
        session.removeRun(removed);
        QVERIFY(QTest::qWaitFor([&] { return session.runs().size() == 1; }, kPatience_ms));
        QVERIFY(!session.currentRun());
        QVERIFY(QTest::qWaitFor([&] { return session.lastRemovedRun().has_value(); }, kPatience_ms));
        session.restoreRun(removed);
        QVERIFY(QTest::qWaitFor([&] { return session.runs().size() == 2; }, kPatience_ms));
        QCOMPARE(session.runs()[1].frames_done, 15);
        QVERIFY(!session.lastRemovedRun());
    }

    void aRemovedRunIsGoneWhenTheProjectWasClosed() {
        std::filesystem::path project;
        {
            ProjectSession session;
            QVERIFY(openAndWait(session, test::sceneUnderTest(15)));
            QVERIFY(runAndWait(session));
            project = session.project();
            session.removeRun(session.runs()[0].id);
            QVERIFY(QTest::qWaitFor([&] { return session.runs().empty(); }, kPatience_ms));
        }
        ProjectFile file = ProjectFile::open(project);
        QVERIFY(!RunStore(file).lastRemoved());
    }

    void theRunOfAnotherProgramIsWatchedAsItGrows() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(60)));
        std::optional<ResultWriter> other;
        RunRecord record;
        record.sequence = {.path = "/nowhere/scene.mp4", .size = {240, 180}, .frame_count = 60};
        record.last_frame = 59;
        other.emplace(session.project(), record, parameterValues(ChainOptions{}));
        const auto write = [&](FrameIndex frame) {
            FrameResult result;
            result.motion.frame = frame;
            other->write(result);
        };
        write(0);
        QVERIFY(QTest::qWaitFor([&] { return session.runs().size() == 1; }, kPatience_ms));
        QVERIFY(session.runs()[0].live);
        session.showRun(session.runs()[0].id);
        QVERIFY(QTest::qWaitFor([&] { return session.runData() != nullptr; }, kPatience_ms));
        write(1);
        write(2);
        QVERIFY(QTest::qWaitFor([&] { return session.runData()->frames.size() == 3; }, kPatience_ms));
        other.reset();  // as after a kill: the run was never finished
        QVERIFY(QTest::qWaitFor([&] { return !session.runs()[0].live; }, kPatience_ms));
        QCOMPARE(session.runs()[0].state, RunState::running);
        QVERIFY(QTest::qWaitFor([&] { return session.runData()->facts.state == RunState::stopped; }, kPatience_ms));
    }

    void aRunIsSummarisedWhenItEnds() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(40)));
        std::optional<RunFacts> facts;
        connect(&session, &ProjectSession::runSummarised, this,
                [&](const RunRecord&, const RunFacts& found) { facts = found; });
        QVERIFY(runAndWait(session));
        QVERIFY(QTest::qWaitFor([&] { return facts.has_value(); }, kPatience_ms));
        QCOMPARE(facts->state, RunState::finished);
        QCOMPARE(facts->counts.frames, 40);
        QCOMPARE(facts->scale_basis, ScaleBasis{ScaleOrigin::given});
    }

    void theNextVideoIsNotDisturbedByARunThatStillEnds() {
        auto door = std::make_shared<Door>();
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(200, [door](FrameIndex f) { door->pass(f); })));
        session.settings().options.view.oblique = false;  // which reads elsewhere, too
        door->closeFrom(20);
        session.startRun();
        QVERIFY(QTest::qWaitFor([&] { return !session.runs().empty() && session.runs().back().frames_done >= 10; },
                                kPatience_ms));
        Media next = test::sceneUnderTest(50);
        next.identity = "/nowhere/next.mp4";
        QVERIFY(openAndWait(session, next));
        QSignalSpy finished(&session, &ProjectSession::runFinished);
        door->open();
        QVERIFY(session.running() ? finished.wait(kPatience_ms) : true);
        QVERIFY(shows(session, 0));
        QCOMPARE(session.currentFrame(), 0);
        QVERIFY(session.runs().empty());
    }

    void theNumberOfAFrameIsThatOfItsPicture() {
        auto door = std::make_shared<Door>();
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(60, [door](FrameIndex f) { door->pass(f); })));
        QVERIFY(shows(session, 0));
        session.settings().options.view.oblique = false;  // which reads elsewhere, too
        door->closeFrom(40);                              // its picture takes its time
        session.goToFrame(50);
        QCOMPARE(session.currentFrame(), 50);
        QCOMPARE(session.shownFrame(), 0);
        door->open();
        QVERIFY(shows(session, 50));
        QCOMPARE(session.shownFrame(), 50);
    }

    void selectingATrackReadsItsStates() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(60)));
        QVERIFY(runAndWait(session));
        QVERIFY(
            QTest::qWaitFor([&] { return session.runData() && session.runData()->frames.size() == 60; }, kPatience_ms));
        QVERIFY(!session.runData()->tracks.empty());
        const TrackSummary track = session.runData()->tracks.front();  // the run may be read anew meanwhile
        std::vector<TrackFrame> states;
        connect(&session, &ProjectSession::trackStatesRead, this,
                [&](TrackId, const std::vector<TrackFrame>& read) { states = read; });
        session.goToTrack(track.id);
        QVERIFY(QTest::qWaitFor([&] { return !states.empty(); }, kPatience_ms));
        QCOMPARE(static_cast<int>(states.size()), track.frames);
        QVERIFY(session.currentFrame() >= track.first_frame && session.currentFrame() <= track.last_frame);
    }
};

}  // namespace eyrie::ui::session_runs_test

EYRIE_UI_TEST(QCoreApplication, session_runs_test, SessionRunsTest)
#include "session_runs_test.moc"
