#include "ui/session/session_support.h"
#include "ui/support/full_disk.h"
#include "ui/support/live_film.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::session_live_test {

using eyrie::test::LiveSender;
using test::kPatience_ms;
using test::openAndWait;
using test::shows;

namespace fs = std::filesystem;

/// A live source in the session: it is shown as it comes, and nothing of it is lost.
class SessionLiveTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    /// Nobody looks first for how the scale changes over the picture, for which more than a second has to come.
    static void watch(ProjectSession& session, const test::LiveSource& source) {
        session.settings().options.view.oblique = false;
        session.watchLive(source.request);
    }
    static bool showsFrames(const ProjectSession& session, int frames) {
        return QTest::qWaitFor(
            [&] {
                return session.ownRun() != nullptr && session.video() && session.video()->frame_count >= frames &&
                       session.viewFrame().result && !session.viewFrame().image.isNull();
            },
            kPatience_ms);
    }
    /// Whether the recording was opened in place of the source.
    static bool reviews(const ProjectSession& session) {
        return QTest::qWaitFor(
            [&] {
                return !session.running() && !session.opening() && session.runData() != nullptr &&
                       !session.runData()->record.live && session.video() &&
                       session.video()->frame_count >= session.runData()->record.frames_done &&
                       session.timesUs().size() == static_cast<std::size_t>(session.video()->frame_count);
            },
            kPatience_ms);
    }
    static std::vector<RunRecord> runsOf(const fs::path& project) {
        ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
        return RunStore(file).runs();
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void aSourceIsShownAsItComesAndReviewedWhenItEnded() {
        const test::LiveSource source(*home_ / "");
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(10)));
        QSignalSpy lengths(&session, &ProjectSession::changed);
        QSignalSpy finished(&session, &ProjectSession::runFinished);
        watch(session, source);
        QVERIFY(session.running());
        QVERIFY(session.liveSource() != nullptr);
        QVERIFY2(!session.liveStatus(), "nobody has answered yet");
        const LiveSender sender(source.port, {{test::writeFilm(*home_ / "film.ts", 60), 2, 0.3}});
        QVERIFY(showsFrames(session, 20));
        QVERIFY(session.following());
        QCOMPARE(session.project(), source.request.project);
        QCOMPARE(session.video()->size, cv::Size(240, 180));
        QCOMPARE(static_cast<int>(session.timesUs().size()), session.video()->frame_count);
        const auto status = session.liveStatus();
        QVERIFY(status);
        QVERIFY(status->load.facts.frames >= 20);
        QVERIFY(status->load.facts.recorded_bytes > 0);
        QVERIFY(status->load.facts.free_bytes > 0);
        QVERIFY(finished.wait(kPatience_ms));
        QCOMPARE(finished.at(0).at(0).value<RunSummary>().outcome, RunOutcome::finished);
        QVERIFY(std::any_of(lengths.begin(), lengths.end(), [](const QList<QVariant>& change) {
            return change.at(0).value<SessionChange>() == SessionChange::length;
        }));
        QVERIFY(session.liveSource() == nullptr);
        QVERIFY(reviews(session));
        QCOMPARE(session.media()->identity, (*home_ / "live.ts").string());
        QVERIFY(session.runs().back().message.find("no picture came") != std::string::npos);
        session.goToFrame(5);
        QVERIFY(QTest::qWaitFor([&] { return shows(session, 5) && session.viewFrame().result; }, kPatience_ms));
        QVERIFY(session.scale().gsd_known);
    }

    void stoppingKeepsRecordingAndRun() {
        const test::LiveSource source(*home_ / "");
        ProjectSession session;
        QSignalSpy finished(&session, &ProjectSession::runFinished);
        watch(session, source);
        const LiveSender sender(source.port, {{test::writeFilm(*home_ / "film.ts", 300), 12, 0.3}});
        QVERIFY(showsFrames(session, 20));
        session.stopRun();
        QVERIFY(session.stopping());
        QVERIFY(finished.wait(kPatience_ms));
        QVERIFY(reviews(session));
        QCOMPARE(session.runs().back().state, RunState::finished);
        QVERIFY(session.runs().back().frames_done >= 20);
        QVERIFY(session.runs().back().frames_done < 300);
        QVERIFY(shows(session, session.currentFrame()));
    }

    void whatCameCanBeLookedAtWhileMoreComes() {
        const test::LiveSource source(*home_ / "");
        ProjectSession session;
        watch(session, source);
        const LiveSender sender(source.port, {{test::writeFilm(*home_ / "film.ts", 300), 12, 0.3}});
        QVERIFY(showsFrames(session, 40));
        session.goToFrame(4);
        QVERIFY(!session.following());
        QVERIFY(shows(session, 4));
        QVERIFY(session.running());
        QVERIFY2(session.liveSource() != nullptr, "it is watched all the same");
        session.follow();
        QVERIFY(QTest::qWaitFor([&] { return session.viewFrame().index > 40; }, kPatience_ms));
        session.stopRun();
        QVERIFY(reviews(session));
    }

    void aSourceThatDoesNotAnswerChangesNothing() {
        test::LiveSource source(*home_ / "");
        source.request.stream.connect_s = 0.5;
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(10)));
        const fs::path project = session.project();
        QSignalSpy refused(&session, &ProjectSession::liveRefused);
        QSignalSpy problems(&session, &ProjectSession::problem);
        watch(session, source);
        QVERIFY(refused.wait(kPatience_ms));
        QVERIFY(refused.at(0).at(0).toString().contains(QStringLiteral("check the address")));
        QCOMPARE(problems.count(), 0);
        QVERIFY(!session.running());
        QVERIFY(session.liveSource() == nullptr);
        QCOMPARE(session.project(), project);
        QCOMPARE(session.video()->frame_count, 10);
        QVERIFY(!fs::exists(source.request.project));
        QVERIFY(!fs::exists(*home_ / "live.ts"));
    }

    void waitingForASourceCanBeGivenUp() {
        const test::LiveSource source(*home_ / "");
        ProjectSession session;
        QSignalSpy refused(&session, &ProjectSession::liveRefused);
        QSignalSpy finished(&session, &ProjectSession::runFinished);
        watch(session, source);
        session.stopRun();
        QVERIFY(finished.wait(kPatience_ms));
        QCOMPARE(finished.at(0).at(0).value<RunSummary>().outcome, RunOutcome::stopped);
        QCOMPARE(refused.count(), 0);
        QVERIFY(!fs::exists(source.request.project));
    }

    void aFolderThatIsNotThereIsToldBeforeAnythingIsMade() {
        test::LiveSource source(*home_ / "");
        source.request.project = *home_ / "absent" / "live.eyrie";
        ProjectSession session;
        QSignalSpy refused(&session, &ProjectSession::liveRefused);
        watch(session, source);
        QVERIFY(refused.wait(kPatience_ms));
        QVERIFY(refused.at(0).at(0).toString().contains(QStringLiteral("does not exist; make it first")));
    }

    void aRecordingTakesThePlaceOfNoFile() {
        test::LiveSource source(*home_ / "");
        source.request.stream.recording = test::writeFilm(*home_ / "mine.ts", 10);
        const auto size = fs::file_size(*home_ / "mine.ts");
        ProjectSession session;
        QSignalSpy refused(&session, &ProjectSession::liveRefused);
        watch(session, source);
        QVERIFY(refused.wait(kPatience_ms));
        QVERIFY(refused.at(0).at(0).toString().contains(QStringLiteral("exists already")));
        QCOMPARE(fs::file_size(*home_ / "mine.ts"), size);
    }

    void anotherPictureSizeEndsItAndSaysSo() {
        const test::LiveSource source(*home_ / "");
        ProjectSession session;
        watch(session, source);
        const LiveSender sender(source.port, {{test::writeFilm(*home_ / "a.ts", 40), 1.5, 0.3},
                                              {test::writeFilm(*home_ / "b.ts", 40, {320, 200}), 1.5, 0}});
        QVERIFY(showsFrames(session, 10));
        QVERIFY(reviews(session));
        QVERIFY(session.runs().back().message.find("changed from 240×180 px to 320×200 px") != std::string::npos);
    }

    void aFullDiskIsToldAndWhatWasStoredStays() {
        const test::LiveSource source(*home_ / "");
        ProjectSession session;
        QSignalSpy problems(&session, &ProjectSession::problem);
        QSignalSpy finished(&session, &ProjectSession::runFinished);
        watch(session, source);
        const LiveSender sender(source.port, {{test::writeFilm(*home_ / "film.ts", 300), 12, 0.3}});
        QVERIFY(showsFrames(session, 20));
        const int shown = session.viewFrame().index;
        {
            const test::FullDisk full;
            QVERIFY(finished.wait(kPatience_ms));
        }
        QVERIFY(problems.count() >= 1);
        QCOMPARE(finished.at(0).at(0).value<RunSummary>().outcome, RunOutcome::failed);
        QVERIFY(runsOf(source.request.project).back().frames_done >= shown);
        QVERIFY(fs::file_size(*home_ / "live.ts") > 0);
    }

    void closingWhileItIsWatchedKeepsAll() {
        const test::LiveSource source(*home_ / "");
        const fs::path film = test::writeFilm(*home_ / "film.ts", 300);
        {
            ProjectSession session;
            watch(session, source);
            const LiveSender sender(source.port, {{film, 12, 0.3}});
            QVERIFY(showsFrames(session, 20));
        }
        const auto runs = runsOf(source.request.project);
        QCOMPARE(runs.size(), std::size_t(1));
        QVERIFY(runs[0].frames_done >= 20);
        QCOMPARE(runs[0].state, RunState::finished);
        QCOMPARE(openSource(*home_ / "live.ts")->info().frame_count, runs[0].frames_done);
    }

    void anotherVideoEndsIt() {
        const test::LiveSource source(*home_ / "");
        ProjectSession session;
        watch(session, source);
        const LiveSender sender(source.port, {{test::writeFilm(*home_ / "film.ts", 300), 12, 0.3}});
        QVERIFY(showsFrames(session, 10));
        QVERIFY(openAndWait(session, test::sceneUnderTest(10)));
        QVERIFY(QTest::qWaitFor([&] { return !session.running(); }, kPatience_ms));
        QCOMPARE(session.video()->frame_count, 10);
        QVERIFY2(!session.opening(), "the recording does not come in its place");
        QCOMPARE(runsOf(source.request.project)[0].state, RunState::finished);
    }
};

}  // namespace eyrie::ui::session_live_test

EYRIE_UI_TEST(QCoreApplication, session_live_test, SessionLiveTest)
#include "session_live_test.moc"
