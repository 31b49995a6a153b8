#include <fstream>
#include <optional>
#include <stdexcept>

#include "session/background/background_query.h"
#include "session/background/due_write.h"
#include "session/project/project_location.h"
#include "store/labels/annotation_store.h"
#include "ui/session/session_support.h"
#include "ui/support/full_disk.h"
#include "ui/support/ui_test.h"
#include "widgets/wiring.h"

namespace eyrie::ui::session_projects_test {

using test::kPatience_ms;
using test::openAndWait;
using test::runAndWait;
using test::shows;

/// Where a project and its video lie, and what stays with them.
class SessionProjectsTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kPatience_ms); }
    static bool open(ProjectSession& session, const std::filesystem::path& path) {
        QSignalSpy ready(&session, &ProjectSession::ready);
        session.open(path);
        return ready.wait(kPatience_ms);
    }
    /// A folder of images whose project, beside it, holds a run.
    std::filesystem::path folderWithRun(int frames = 12, const std::string& name = "images") {
        const auto folder = test::writeScene(*home_ / "flights" / name, frames);
        ProjectSession session;
        if (!open(session, folder) || !runAndWait(session)) return {};
        return folder;
    }
    std::filesystem::path project(const std::string& name = "images") { return *home_ / "flights" / (name + ".eyrie"); }
    /// Whether what is done in the lists of the project that is shown arrives there.
    static bool listsAreOpen(ProjectSession& session) {
        session.renameRun(session.runs().front().id, QStringLiteral("renamed"));
        return waitFor([&] { return session.runs().front().name == "renamed"; });
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void theProjectLiesBesideItsVideo() {
        const auto folder = folderWithRun();
        QVERIFY(!folder.empty());
        QVERIFY(std::filesystem::exists(project()));
        ProjectSession session;
        QVERIFY(open(session, folder));
        QCOMPARE(session.project(), project());
        QCOMPARE(session.runs().size(), std::size_t(1));
    }

    void aFolderThatCannotBeWrittenLeavesTheDataFolder() {
        ProjectSession session;
        Media media = test::sceneUnderTest(5);
        media.identity = (*home_ / "nowhere" / "clip.mp4").string();  // a project could not be made beside it
        QVERIFY(openAndWait(session, media));
        QCOMPARE(session.project(), projectInDataFolder(media.name, media.identity));
    }

    void aFrameRateGivenOnceStays() {
        const auto folder = test::writeScene(*home_ / "flights" / "images", 12);
        {
            ProjectSession session;
            QVERIFY(open(session, folder));
            QCOMPARE(session.video()->frame_rate_hz, 25.0);
            session.setFrameRate(30);
            QVERIFY(waitFor([&] { return session.video()->frame_rate_hz == 30; }));
            session.goToFrame(3);
            QVERIFY(shows(session, 3));
            QCOMPARE(session.timesUs()[3], std::int64_t(100'000));
        }
        for (const auto& path : {folder, project()}) {
            ProjectSession session;
            QVERIFY(open(session, path));
            QCOMPARE(session.video()->frame_rate_hz, 30.0);
            QVERIFY(runAndWait(session));
            QVERIFY(waitFor([&] { return session.runData() != nullptr; }));
            QCOMPARE(session.runData()->record.scale.frame_rate_hz, 30.0);
        }
    }

    void aRunAskedForWhileTheRateChangesIsMadeWithIt() {
        ProjectSession session;
        QVERIFY(open(session, test::writeScene(*home_ / "flights" / "images", 8)));
        QSignalSpy finished(&session, &ProjectSession::runFinished);
        session.setFrameRate(10);
        session.startRun();
        QVERIFY(finished.wait(kPatience_ms));
        QCOMPARE(session.runs().back().scale.frame_rate_hz, 10.0);
    }

    void saveAsGoesOnInTheNewFileAndACopyDoesNot() {
        const auto folder = folderWithRun();
        ProjectSession session;
        QVERIFY(open(session, folder));
        QSignalSpy notice(&session, &ProjectSession::notice);
        session.saveProjectCopy(*home_ / "copy.eyrie");
        QVERIFY(notice.wait(kPatience_ms));
        QCOMPARE(session.project(), project());
        const auto other = *home_ / "other.eyrie";
        session.saveProjectAs(other);
        QVERIFY(waitFor([&] { return session.project() == other; }));
        QVERIFY(runAndWait(session));
        ProjectFile former = ProjectFile::open(project());
        ProjectFile present = ProjectFile::open(other);
        QCOMPARE(RunStore(former).runs().size(), std::size_t(1));
        QCOMPARE(RunStore(present).runs().size(), std::size_t(2));
    }

    void whereTheLastChangeCannotBeStoredSaveAsStaysInTheFormerFile() {
        const auto folder = folderWithRun();
        ProjectSession session;
        QVERIFY(open(session, folder));
        BackgroundQuery last_change;
        QObject person;
        const auto change = [&] {
            last_change.write([](const BackgroundTask&) { throw std::runtime_error("the disk is full"); });
        };
        whenChanged(session, &person, {{SessionChange::keep_written, change}});
        QSignalSpy problem(&session, &ProjectSession::problem);
        const auto other = *home_ / "other.eyrie";
        session.saveProjectAs(other);
        QVERIFY(problem.wait(kPatience_ms));
        QVERIFY(problem.last().front().toString().contains(QStringLiteral("could not be stored")));
        QCOMPARE(session.project(), project());
        QVERIFY(waitFor([&] { return session.runData() != nullptr; }));
        QVERIFY(listsAreOpen(session));
        for (const auto& entry : std::filesystem::directory_iterator(other.parent_path()))
            QVERIFY(!entry.path().filename().string().starts_with("other"));
    }

    void whatIsAtWorkIsWaitedForBeforeTheProjectIsSavedUnderAnotherName() {
        const auto folder = folderWithRun();
        ProjectSession session;
        QVERIFY(open(session, folder));
        std::optional<DueWrite> work(std::in_place);
        QObject person;
        bool asked_to_end = false;
        whenChanged(session, &person, {{SessionChange::work_ends, [&] { asked_to_end = true; }}});
        const auto other = *home_ / "other.eyrie";
        session.saveProjectAs(other);
        QVERIFY(waitFor([&] { return asked_to_end; }));
        QCOMPARE(session.project(), project());  // what comes of it can be stored there
        work.reset();
        QVERIFY(waitFor([&] { return session.project() == other; }));
    }

    void whatTheWorkThatIsWaitedForCouldNotStoreKeepsSaveAsInTheFormerFile() {
        const auto folder = folderWithRun();
        ProjectSession session;
        QVERIFY(open(session, folder));
        BackgroundQuery found;
        QObject person;
        const auto end = [&] {
            found.write([](const BackgroundTask&) { throw std::runtime_error("the disk is full"); });
        };
        whenChanged(session, &person, {{SessionChange::work_ends, end}});
        QSignalSpy problem(&session, &ProjectSession::problem);
        session.saveProjectAs(*home_ / "other.eyrie");
        QVERIFY(problem.wait(kPatience_ms));
        QVERIFY(problem.last().front().toString().contains(QStringLiteral("could not be stored")));
        QCOMPARE(session.project(), project());
        QVERIFY(listsAreOpen(session));
    }

    void whileWorkIsWaitedForAProjectThatCannotBeOpenedLeavesTheCopy() {
        const auto folder = folderWithRun();
        ProjectSession session;
        QVERIFY(open(session, folder));
        const auto broken = *home_ / "broken.eyrie";
        std::ofstream(broken) << "no project";
        const DueWrite work;  // does not end
        QObject person;
        bool asked_to_end = false;
        whenChanged(session, &person, {{SessionChange::work_ends, [&] { asked_to_end = true; }}});
        const auto other = *home_ / "other.eyrie";
        session.saveProjectAs(other);
        QVERIFY(waitFor([&] { return asked_to_end; }));
        QSignalSpy problem(&session, &ProjectSession::problem);
        session.openProject(broken);
        QVERIFY(problem.wait(kPatience_ms));
        QVERIFY(waitFor([&] { return session.project() == other; }));
        QVERIFY(listsAreOpen(session));
    }

    void whoWaitsForWritesHearsOfWhatTheProjectDidNotTake() {
        const auto folder = folderWithRun();
        ProjectSession session;
        QVERIFY(open(session, folder));
        WrittenWait wait;
        wait.watch();
        {
            const test::FullDisk full;
            session.renameRun(session.runs().front().id, QStringLiteral("not to be stored"));
            QVERIFY(waitFor([&] { return !wait.anythingDue(); }));
        }
        QVERIFY(wait.anythingFailed());
    }

    void whatWasDoneLastIsKeptWhenAllIsClosedAtOnce() {
        const auto folder = folderWithRun();
        {
            ProjectSession session;
            QVERIFY(open(session, folder));
            session.renameRun(session.runs().front().id, QStringLiteral("the last thing done"));
        }
        ProjectFile file = ProjectFile::open(project());
        QCOMPARE(RunStore(file).runs().front().name, std::string("the last thing done"));
    }

    void aVideoThatMovedWithItsProjectIsFound() {
        QVERIFY(!folderWithRun().empty());
        const auto moved = *home_ / "archive";
        std::filesystem::rename(*home_ / "flights", moved);
        {
            ProjectSession session;
            QVERIFY(open(session, moved / "images.eyrie"));
            QVERIFY(!session.videoMissing());
            QVERIFY(shows(session, 0));
            QCOMPARE(session.media()->identity, (moved / "images").string());
            QVERIFY(session.currentRun());
        }
        ProjectFile file = ProjectFile::open(moved / "images.eyrie");
        QCOMPARE(sequencesOf(file).size(), std::size_t(1));
        QCOMPARE(sequencesOf(file).front().path, (moved / "images").string());
    }

    void theRunsOfAMovedVideoAreShownWhenTheVideoIsOpened() {
        QVERIFY(!folderWithRun().empty());
        const auto moved = *home_ / "archive";
        std::filesystem::rename(*home_ / "flights", moved);
        ProjectSession session;
        QVERIFY(open(session, moved / "images"));
        QCOMPARE(session.project(), moved / "images.eyrie");
        QVERIFY(session.currentRun());
        QCOMPARE(session.runs().front().sequence.path, (moved / "images").string());
    }

    void aVideoThatIsNowhereCanBeLocated() {
        const auto folder = folderWithRun();
        const auto elsewhere = *home_ / "elsewhere";
        std::filesystem::rename(folder, elsewhere);
        const auto shorter = test::writeScene(*home_ / "shorter", 5);
        ProjectSession session;
        QSignalSpy not_found(&session, &ProjectSession::videoNotFound);
        QVERIFY(open(session, project()));
        QVERIFY(session.videoMissing());
        QCOMPARE(not_found.count(), 1);
        session.locateVideo({shorter});
        QVERIFY(not_found.wait(kPatience_ms));
        QVERIFY(not_found.last().at(0).toString().contains(QStringLiteral("another video")));
        QVERIFY(session.videoMissing());
        session.locateVideo({elsewhere});
        QVERIFY(waitFor([&] { return !session.videoMissing(); }));
        QVERIFY(shows(session, 0));
        QVERIFY(session.currentRun());
        ProjectSession again;
        QVERIFY(waitFor([&] {
            ProjectFile file = ProjectFile::open(project(), ProjectFile::Mode::read_only);
            return RunStore(file).runs().front().sequence.path == elsewhere.string();
        }));
        QVERIFY(open(again, project()));
        QVERIFY(!again.videoMissing());
    }

    void aProjectThatCannotBeOpenedLeavesTheFormerOneAsItWas() {
        const auto folder = folderWithRun();
        QVERIFY(!folder.empty());
        ProjectSession session;
        QVERIFY(open(session, folder));
        const auto broken = *home_ / "broken.eyrie";
        std::ofstream(broken) << "no project";
        QSignalSpy problem(&session, &ProjectSession::problem);
        session.openProject(broken);
        QVERIFY(problem.wait(kPatience_ms));
        QCOMPARE(session.project(), project());
        QVERIFY(session.currentRun());
        QVERIFY(listsAreOpen(session));
    }

    void ofTwoProjectsTheOneAskedForLastIsShownWithItsVideo() {
        QVERIFY(!folderWithRun().empty() && !folderWithRun(10, "second").empty() && !folderWithRun(8, "third").empty());
        ProjectSession session;
        QVERIFY(open(session, *home_ / "flights" / "images"));
        session.openProject(project("second"));
        session.openProject(project("third"));
        const std::string third = (*home_ / "flights" / "third").string();
        QVERIFY(waitFor([&] { return session.project() == project("third") && session.media()->identity == third; }));
        QVERIFY(session.currentRun() && !session.opening());
        QCOMPARE(session.runs().front().sequence.path, third);
        QVERIFY(listsAreOpen(session));
    }

    void aProjectThatAVideoOvertookDoesNotComeBetween() {
        QVERIFY(!folderWithRun().empty() && !folderWithRun(10, "second").empty());
        ProjectSession session;
        QVERIFY(open(session, *home_ / "flights" / "images"));
        QSignalSpy problem(&session, &ProjectSession::problem);
        session.openProject(project("second"));
        session.open(*home_ / "flights" / "nothing.mp4");  // which cannot be opened
        QVERIFY(problem.wait(kPatience_ms));
        QVERIFY(listsAreOpen(session));
        QCOMPARE(session.project(), project());
        QCOMPARE(session.runs().front().sequence.path, session.media()->identity);
        QCOMPARE(session.media()->identity, (*home_ / "flights" / "images").string());
    }

    void theGsdFollowsTheRunThatIsShown() {
        const auto folder = folderWithRun();
        ProjectSession session;
        QVERIFY(open(session, folder));
        session.settings().gsd_m_per_px = 0.5;
        QVERIFY(runAndWait(session));
        QVERIFY(waitFor([&] { return session.runs().size() == 2; }));
        session.settings().gsd_m_per_px = 0.3;
        session.showRun(session.runs()[0].id);
        QCOMPARE(session.settings().gsd_m_per_px, 0.0);  // made without one
        session.showRun(session.runs()[1].id);
        QCOMPARE(session.settings().gsd_m_per_px, 0.5);
    }
};

}  // namespace eyrie::ui::session_projects_test

EYRIE_UI_TEST(QCoreApplication, session_projects_test, SessionProjectsTest)
#include "session_projects_test.moc"
