#include <QSignalSpy>
#include <QTest>
#include <atomic>
#include <condition_variable>
#include <fstream>
#include <mutex>

#include "core/error.h"
#include "session/kept_scene.h"
#include "session/preset_store.h"
#include "session/project_location.h"
#include "session/project_session.h"
#include "ui/ui_support.h"

namespace eyrie::ui {

using test::kPatience_ms;

/// A door that a run has to wait at, so that tests see it at work for as long as they need.
class Door {
 public:
    void pass(FrameIndex frame) {
        std::unique_lock lock(mutex_);
        reached_ = std::max(reached_, frame);
        changed_.notify_all();
        changed_.wait(lock, [&] { return frame < closed_from_; });
    }
    void closeFrom(FrameIndex frame) {
        const std::scoped_lock lock(mutex_);
        closed_from_ = frame;
        changed_.notify_all();
    }
    void open() { closeFrom(1 << 30); }
    FrameIndex reached() {
        const std::scoped_lock lock(mutex_);
        return reached_;
    }

 private:
    std::mutex mutex_;
    std::condition_variable changed_;
    FrameIndex reached_ = -1;
    FrameIndex closed_from_ = 1 << 30;
};

class SessionTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static bool openAndWait(ProjectSession& session, const Media& media) {
        QSignalSpy ready(&session, &ProjectSession::ready);
        session.openMedia(media);
        return ready.wait(kPatience_ms);
    }
    static bool runAndWait(ProjectSession& session) {
        QSignalSpy finished(&session, &ProjectSession::runFinished);
        session.startRun();
        return session.running() && finished.wait(kPatience_ms);
    }
    static bool shows(const ProjectSession& session, FrameIndex frame) {
        return QTest::qWaitFor(
            [&] { return session.viewFrame().index == frame && !session.viewFrame().image.isNull(); }, kPatience_ms);
    }

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
        QSignalSpy data(&session, &ProjectSession::runDataChanged);
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
        connect(&session, &ProjectSession::viewFrameChanged, this, [&](const ViewFrame& frame) {
            if (session.following() && frame.result) live = frame;
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
    }

    void stoppingKeepsWhatIsDone() {
        auto door = std::make_shared<Door>();
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(200, [door](FrameIndex f) { door->pass(f); })));
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

    void theWindowThreadNeverReadsPicturesOrResults() {
        std::atomic<bool> on_window_thread = false;
        const auto window_thread = std::this_thread::get_id();
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(60, [&](FrameIndex) {
                                if (std::this_thread::get_id() == window_thread) on_window_thread = true;
                            })));
        QVERIFY(session.loader().workerId() != window_thread);
        QVERIFY(runAndWait(session));
        session.playback().setSpeed(8, 0);
        session.goToFrame(0);
        QSignalSpy playing(&session.playback(), &Playback::playingChanged);
        session.togglePlay();
        QVERIFY(QTest::qWaitFor([&] { return playing.count() >= 2; }, kPatience_ms));
        QVERIFY(!on_window_thread);
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
        connect(&session, &ProjectSession::frameChanged, this, [&](FrameIndex frame) {
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
        QSignalSpy problem(&session, &ProjectSession::problem);
        QSignalSpy ready(&session, &ProjectSession::ready);
        session.open(project);
        QVERIFY(ready.wait(kPatience_ms));
        QCOMPARE(problem.count(), 1);
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
        session.removeRun(session.runs()[1].id);
        QVERIFY(QTest::qWaitFor([&] { return session.runs().size() == 1; }, kPatience_ms));
        QVERIFY(!session.currentRun());
    }

    void aCopyOfTheProjectIsWhole() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(20)));
        QVERIFY(runAndWait(session));
        QSignalSpy notice(&session, &ProjectSession::notice);
        const auto copy = *home_ / "copy.eyrie";
        session.saveProjectCopy(copy);
        QVERIFY(notice.wait(kPatience_ms));
        ProjectFile file = ProjectFile::open(copy);
        QCOMPARE(RunStore(file).runs().size(), std::size_t(1));
        QSignalSpy problem(&session, &ProjectSession::problem);
        session.saveProjectCopy(session.project());
        QVERIFY(problem.wait(kPatience_ms));
        session.saveProjectCopy("/no/such/folder/copy.eyrie");
        QVERIFY(problem.wait(kPatience_ms));
    }

    void selectingATrackReadsItsStates() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(60)));
        QVERIFY(runAndWait(session));
        QVERIFY(
            QTest::qWaitFor([&] { return session.runData() && session.runData()->frames.size() == 60; }, kPatience_ms));
        if (session.runData()->tracks.empty()) QSKIP("the chain found no track in the toy scene");
        const TrackSummary& track = session.runData()->tracks.front();
        std::vector<TrackFrame> states;
        connect(&session, &ProjectSession::trackStatesRead, this,
                [&](TrackId, const std::vector<TrackFrame>& read) { states = read; });
        session.goToTrack(track.id);
        QVERIFY(QTest::qWaitFor([&] { return !states.empty(); }, kPatience_ms));
        QCOMPARE(static_cast<int>(states.size()), track.frames);
        QVERIFY(session.currentFrame() >= track.first_frame && session.currentFrame() <= track.last_frame);
    }

    void theSameVideoFindsItsProjectAndAnotherDoesNot() {
        const auto a = defaultProjectPath("clip.mp4", "/videos/a/clip.mp4");
        QCOMPARE(a, defaultProjectPath("clip.mp4", "/videos/a/clip.mp4"));
        QVERIFY(a != defaultProjectPath("clip.mp4", "/videos/b/clip.mp4"));
        QVERIFY(a.filename().string().starts_with("clip-"));
        QCOMPARE(a.extension(), std::filesystem::path(".eyrie"));
        const auto odd = defaultProjectPath("a / strange: name *.mp4", "x").filename().string();
        QVERIFY(odd.find_first_of("/:* ") == std::string::npos);
    }

    void framesOfASceneAreRenderedOnceAndKeptWithoutLoss() {
        const auto folder = *home_ / "scenes";
        const auto scene = std::make_shared<KeptScene>("egtest01", folder);
        const auto source = scene->open();
        QVERIFY(source->info().frame_count > 0);
        const Frame rendered = source->read(3, true);
        QCOMPARE(rendered.index, 3);
        // Another program of the same build finds them; a changed file shows that it is read, not rendered again.
        const auto again = std::make_shared<KeptScene>("egtest01", folder)->open();
        const Frame kept = again->read(3, true);
        QCOMPARE(cv::norm(kept.gray, rendered.gray, cv::NORM_INF), 0.0);
        QCOMPARE(cv::norm(kept.colour, rendered.colour, cv::NORM_INF), 0.0);
        QCOMPARE(kept.time_us, rendered.time_us);
        std::filesystem::path file;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.path().filename() == "000003.png") file = entry.path();
        cv::imwrite(file.string(), cv::Mat(rendered.colour.size(), CV_8UC3, cv::Scalar(1, 2, 3)));
        QCOMPARE(again->read(3, true).colour.at<cv::Vec3b>(5, 5), cv::Vec3b(1, 2, 3));
        QVERIFY_EXCEPTION_THROWN(std::make_shared<KeptScene>("no such scene", folder)->open(), Error);
    }

    void presetsAreSavedListedAndRefusedWhenBuiltIn() {
        const PresetStore presets(*home_ / "presets");
        QVERIFY(presets.names().size() >= 2);
        ChainOptions options = presets.load("default");
        presets.save("mine", options);
        QCOMPARE(presets.names().back(), std::string("mine"));
        QCOMPARE(parameterValues(presets.load("mine")), parameterValues(options));
        QVERIFY_EXCEPTION_THROWN(presets.save("default", options), Error);
        QVERIFY_EXCEPTION_THROWN(presets.save("../x", options), Error);
        QVERIFY_EXCEPTION_THROWN(presets.load("none such"), Error);
    }
};

}  // namespace eyrie::ui

QTEST_GUILESS_MAIN(eyrie::ui::SessionTest)
#include "session_test.moc"
