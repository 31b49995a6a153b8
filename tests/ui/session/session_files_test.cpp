#include <fstream>

#include "core/error.h"
#include "session/project/preset_store.h"
#include "session/project/project_location.h"
#include "session/project/scene_frame_cache.h"
#include "store/labels/annotation_store.h"
#include "ui/session/session_support.h"
#include "ui/support/full_disk.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::session_files_test {

using test::kPatience_ms;
using test::openAndWait;
using test::runAndWait;

class SessionFilesTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

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

    void afterAFullDiskRunsAndCopiesGoOn() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(20)));
        QVERIFY(runAndWait(session));
        QSignalSpy problem(&session, &ProjectSession::problem);
        const auto copy = *home_ / "copy.eyrie";
        {
            const test::FullDisk full(5000);
            session.saveProjectCopy(copy);
            QVERIFY(problem.wait(kPatience_ms));
            QVERIFY(runAndWait(session));
        }
        QVERIFY(!std::filesystem::exists(copy));
        QVERIFY(problem.size() >= 2);
        for (const auto& told : problem)
            QVERIFY2(told.at(0).toString().contains(QStringLiteral("disk")), qPrintable(told.at(0).toString()));
        QVERIFY(runAndWait(session));
        session.saveProjectCopy(copy);
        QVERIFY(QTest::qWaitFor([&] { return std::filesystem::exists(copy); }, kPatience_ms));
        QVERIFY(QTest::qWaitFor([&] { return !session.runs().empty(); }, kPatience_ms));
        QCOMPARE(session.runs().front().frames_done, 20);
        QCOMPARE(session.runs().back().state, RunState::finished);
    }

    void theSameVideoFindsItsProjectAndAnotherDoesNot() {
        const auto a = projectInDataFolder("clip.mp4", "/videos/a/clip.mp4");
        QCOMPARE(a, projectInDataFolder("clip.mp4", "/videos/a/clip.mp4"));
        QVERIFY(a != projectInDataFolder("clip.mp4", "/videos/b/clip.mp4"));
        QVERIFY(a.filename().string().starts_with("clip-"));
        QCOMPARE(a.extension(), std::filesystem::path(".eyrie"));
        const auto odd = projectInDataFolder("a / strange: name *.mp4", "x").filename().string();
        QVERIFY(odd.find_first_of("/:* ") == std::string::npos);
    }

    void aProjectLiesBesideItsVideoUnlessThereIsOneInTheDataFolder() {
        const auto folder = *home_ / "flight.2";
        std::filesystem::create_directories(folder);
        const auto beside = *home_ / "flight.2.eyrie";  // a folder has no ending to be taken off
        QCOMPARE(projectPlaces("flight.2", folder.string()).front(), beside);
        QCOMPARE(projectPlaces("clip.mp4", (folder / "clip.mp4").string()).front(), folder / "clip.eyrie");
        QCOMPARE(projectPlaces("demo scene", "scene:demo").size(), std::size_t(1));
        const auto hidden = projectInDataFolder("flight.2", folder.string());
        std::filesystem::create_directories(hidden.parent_path());
        ProjectFile::create(hidden);
        QCOMPARE(projectPlaces("flight.2", folder.string()).front(), hidden);
        ProjectFile::create(beside);
        QCOMPARE(projectPlaces("flight.2", folder.string()).front(), beside);
    }

    void aCopyReplacesNothing() {
        ProjectSession session;
        QVERIFY(openAndWait(session, test::sceneUnderTest(5)));
        QSignalSpy problem(&session, &ProjectSession::problem);
        const auto video = *home_ / "clip.mp4";
        std::ofstream(video) << "pictures";
        session.saveProjectCopy(video);
        QVERIFY(problem.wait(kPatience_ms));
        QCOMPARE(std::filesystem::file_size(video), std::uintmax_t(8));
        const auto other = *home_ / "other.eyrie";
        ProjectFile at_work = ProjectFile::create(other);
        ensureSequence(at_work, {.path = "/nowhere/other.mp4", .size = {10, 10}, .frame_count = 1});
        session.saveProjectCopy(other);
        QVERIFY(problem.wait(kPatience_ms));
        QCOMPARE(sequencesOf(at_work).front().path, std::string("/nowhere/other.mp4"));
    }

    void framesOfASceneAreRenderedOnceAndKeptWithoutLoss() {
        const auto folder = *home_ / "scenes";
        const auto scene = std::make_shared<SceneFrameCache>("egtest01", folder);
        const auto source = scene->open();
        QVERIFY(source->info().frame_count > 0);
        const Frame rendered = source->read(3, true);
        QCOMPARE(rendered.index, 3);
        // Another program of the same build finds them; a changed file shows that it is read, not rendered again.
        const auto again = std::make_shared<SceneFrameCache>("egtest01", folder)->open();
        const Frame kept = again->read(3, true);
        QCOMPARE(cv::norm(kept.gray, rendered.gray, cv::NORM_INF), 0.0);
        QCOMPARE(cv::norm(kept.colour, rendered.colour, cv::NORM_INF), 0.0);
        QCOMPARE(kept.time_us, rendered.time_us);
        std::filesystem::path file;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.path().filename() == "000003.png") file = entry.path();
        cv::imwrite(file.string(), cv::Mat(rendered.colour.size(), CV_8UC3, cv::Scalar(1, 2, 3)));
        QCOMPARE(again->read(3, true).colour.at<cv::Vec3b>(5, 5), cv::Vec3b(1, 2, 3));
        QVERIFY_EXCEPTION_THROWN(std::make_shared<SceneFrameCache>("no such scene", folder)->open(), Error);
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

}  // namespace eyrie::ui::session_files_test

EYRIE_UI_TEST(QCoreApplication, session_files_test, SessionFilesTest)
#include "session_files_test.moc"
