#include <fstream>
#include <sstream>

#include "io/video/video_writer.h"
#include "session/project/project_location.h"
#include "store/labels/annotation_store.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::session_parts_test {

using test::kPatience_ms;
using test::runAndWait;
using test::shows;

/// Several files that are one video: opened, opened again, moved, missing.
class SessionPartsTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kPatience_ms); }
    static bool open(ProjectSession& session, const std::vector<std::filesystem::path>& files) {
        QSignalSpy ready(&session, &ProjectSession::ready);
        session.open(files);
        return ready.wait(kPatience_ms);
    }
    static void film(const std::filesystem::path& path, int first, int frames, cv::Size size = {240, 180}) {
        std::filesystem::create_directories(path.parent_path());
        VideoWriter writer(path, size);
        for (int i = first; i < first + frames; ++i) {
            cv::Mat picture;
            cv::cvtColor(test::sceneFrame(i, size), picture, cv::COLOR_GRAY2BGR);
            writer.write(picture);
        }
        writer.finish();
    }
    std::filesystem::path folder() const { return *home_ / "flights"; }
    /// Two parts of 10 and 8 frames; named in the wrong order.
    std::vector<std::filesystem::path> files() const { return {folder() / "rec_10.mp4", folder() / "rec_9.mp4"}; }
    std::filesystem::path list() const { return folder() / "rec_9-rec_10.parts"; }
    std::filesystem::path project() const { return folder() / "rec_9-rec_10.eyrie"; }
    static std::string textOf(const std::filesystem::path& file) {
        std::stringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    }
    bool hasRun() {
        ProjectSession session;
        return open(session, files()) && runAndWait(session);
    }

 private slots:
    void init() {
        home_ = std::make_unique<test::OwnHome>();
        film(folder() / "rec_9.mp4", 0, 10);
        film(folder() / "rec_10.mp4", 10, 8);
    }
    void cleanup() { home_.reset(); }

    void severalFilesAreOneVideoInTheOrderOfTheirNumbers() {
        ProjectSession session;
        QVERIFY(open(session, files()));
        QCOMPARE(session.video()->frame_count, 18);
        QCOMPARE(session.video()->parts.size(), std::size_t(2));
        QCOMPARE(session.video()->parts.front().file, folder() / "rec_9.mp4");
        QCOMPARE(session.media()->identity, list().string());
        QCOMPARE(session.media()->name, std::string("rec_9-rec_10"));
        QCOMPARE(session.project(), project());
        QCOMPARE(session.partText(9), QStringLiteral("rec_9.mp4, its frame 9 of 10"));
        QCOMPARE(session.partText(10), QStringLiteral("rec_10.mp4, its frame 0 of 8"));
        QCOMPARE(session.partText(18), QString());
        session.goToFrame(12);
        QVERIFY(shows(session, 12));
        QVERIFY(open(session, {folder() / "rec_9.mp4"}));
        QCOMPARE(session.video()->frame_count, 10);
        QCOMPARE(session.partText(3), QString());
    }

    void theFilesTheListAndTheProjectOpenTheSame() {
        QVERIFY(hasRun());
        const std::vector<std::vector<std::filesystem::path>> ways{files(), {list()}, {project()}};
        for (const auto& opened : ways) {
            ProjectSession session;
            QVERIFY(open(session, opened));
            QCOMPARE(session.project(), project());
            QCOMPARE(session.runs().size(), std::size_t(1));
            QVERIFY(waitFor([&] { return session.runData() != nullptr; }));
            QCOMPARE(session.runData()->frames.size(), std::size_t(18));
        }
        ProjectFile file = ProjectFile::open(project(), ProjectFile::Mode::read_only);
        QCOMPARE(sequencesOf(file).size(), std::size_t(1));
        QCOMPARE(sequencesOf(file).front().path, list().string());
    }

    void aFolderThatMovedWithAllItHoldsIsFound() {
        QVERIFY(hasRun());
        const auto moved = *home_ / "archive";
        std::filesystem::rename(folder(), moved);
        ProjectSession session;
        QVERIFY(open(session, {moved / project().filename()}));
        QVERIFY(!session.videoMissing());
        QCOMPARE(session.media()->identity, (moved / list().filename()).string());
        session.goToFrame(15);
        QVERIFY(shows(session, 15));
    }

    void aPartThatIsMissingIsNamedLocatedAndRemembered() {
        QVERIFY(hasRun());
        const auto elsewhere = *home_ / "elsewhere" / "rec_10.mp4";
        std::filesystem::create_directory(elsewhere.parent_path());
        std::filesystem::rename(files().front(), elsewhere);
        ProjectSession session;
        QSignalSpy not_found(&session, &ProjectSession::videoNotFound);
        QVERIFY(open(session, {project()}));
        QVERIFY(session.videoMissing());
        QVERIFY(not_found.last().at(0).toString().contains(QStringLiteral("part 2 of 2")));
        QVERIFY(not_found.last().at(0).toString().contains(QStringLiteral("rec_10.mp4, is not there")));
        QVERIFY(session.currentRun());
        const std::string before = textOf(list());
        film(*home_ / "wrong" / "rec_10.mp4", 3, 8);
        session.locateVideo({*home_ / "wrong" / "rec_10.mp4"});
        QVERIFY(not_found.wait(kPatience_ms));
        QVERIFY(session.videoMissing());
        QCOMPARE(textOf(list()), before);
        QSignalSpy notice(&session, &ProjectSession::notice);
        session.locateVideo({elsewhere});
        QVERIFY(waitFor([&] { return !session.videoMissing(); }));
        QVERIFY(notice.last().at(0).toString().contains(QStringLiteral("All parts are found")));
        session.goToFrame(14);
        QVERIFY(shows(session, 14));
        ProjectSession again;
        QVERIFY(open(again, {project()}));
        QVERIFY(!again.videoMissing());
        QCOMPARE(again.video()->parts[1].file, elsewhere);
    }

    void aListThatIsGoneIsMadeAnewFromItsFiles() {
        QVERIFY(hasRun());
        std::filesystem::remove(list());
        ProjectSession session;
        QVERIFY(open(session, {project()}));
        QVERIFY(session.videoMissing());
        session.locateVideo(files());
        QVERIFY(waitFor([&] { return !session.videoMissing(); }));
        QCOMPARE(session.media()->identity, list().string());
        QVERIFY(std::filesystem::exists(list()));
    }

    void filesThatAreNotAlikeAreRefusedByName() {
        film(folder() / "rec_10.mp4", 10, 8, {200, 180});
        ProjectSession session;
        QSignalSpy problem(&session, &ProjectSession::problem);
        session.open(files());
        QVERIFY(problem.wait(kPatience_ms));
        QVERIFY(problem.last().at(0).toString().contains(QStringLiteral("rec_10.mp4, is 200×180 px")));
        QVERIFY(!session.video());
        QVERIFY(!std::filesystem::exists(list()));
    }

    void aRateGivenOnceStays() {
        {
            ProjectSession session;
            QVERIFY(open(session, files()));
            session.setFrameRate(10);
            QVERIFY(waitFor([&] { return session.video()->frame_rate_hz == 10; }));
            QCOMPARE(session.timesUs()[10], std::int64_t(1'000'000));
            QVERIFY(waitFor([&] {
                ProjectFile file = ProjectFile::open(project(), ProjectFile::Mode::read_only);
                const auto videos = sequencesOf(file);
                return !videos.empty() && videos.front().frame_rate_hz == 10;
            }));
        }
        ProjectSession session;
        QVERIFY(open(session, files()));
        QCOMPARE(session.video()->frame_rate_hz, 10.0);
    }
};

}  // namespace eyrie::ui::session_parts_test

EYRIE_UI_TEST(QCoreApplication, session_parts_test, SessionPartsTest)
#include "session_parts_test.moc"
