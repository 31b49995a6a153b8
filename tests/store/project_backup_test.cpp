#include "store/backup/project_backup.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "store/health/project_contents.h"
#include "store/project/schema.h"
#include "store/runs/result_writer.h"
#include "store/samples.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace eyrie::project_backup_test {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr UtcTime kLongAgo = std::chrono::sys_days(std::chrono::year(2020) / 5 / 1) + 9h;
/// Frames large enough that a copy takes several steps.
const test::SampleSize kLarge{20000, 3000, 20, 20, 20, {768, 576}};

class BackupTest : public testing::Test {
 protected:
    BackupResult backUpAt(UtcTime when, BackupReason reason = BackupReason::before_restoring) const {
        BackupRequest request;
        request.reason = reason;
        request.now = when;
        return backUp(path_, request);
    }
    /// All that lies in the folder of copies.
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        std::error_code none;
        for (const auto& entry : std::filesystem::directory_iterator(backupFolderOf(path_), none)) {
            names.push_back(entry.path().filename());
        }
        return names;
    }
    std::string integrity() const {
        return SQLite::Database(path_.string(), SQLite::OPEN_READONLY).execAndGet("PRAGMA integrity_check").getString();
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
};

TEST_F(BackupTest, IsAProjectOfOneFileWithEverythingInIt) {
    test::writeSampleProject(path_, 5);
    const BackupResult result = backUpAt(kLongAgo);
    ASSERT_EQ(result.outcome, BackupOutcome::made) << result.notice;
    ASSERT_TRUE(result.backup.has_value());
    EXPECT_THAT(files(), testing::ElementsAre("2020-05-01T09-00-00Z-before-restoring.eyrie"));
    EXPECT_EQ(listBackups(path_).at(0).made, kLongAgo);
    EXPECT_EQ(listBackups(path_).at(0).reason, BackupReason::before_restoring);
    EXPECT_EQ(listBackups(path_).at(0).bytes, std::filesystem::file_size(result.backup->path));

    const auto copy = folder_ / "copy.eyrie";
    std::filesystem::copy_file(result.backup->path, copy);
    std::filesystem::permissions(copy, std::filesystem::perms::owner_all);
    ProjectFile project = ProjectFile::open(copy);
    for (int frame = 0; frame < 5; ++frame) {
        test::expectSame(*RunStore(project).frameResult(1, frame), test::sampleFrame(frame));
    }
}

TEST_F(BackupTest, HoldsAWorkingRunAsStopped) {
    ProjectFile::create(path_);
    ResultWriter writer(path_, test::sampleRun(), {});
    writer.write(test::sampleFrame(0, kLarge));
    std::jthread others([&](const std::stop_token& stop) {
        for (int frame = 1; !stop.stop_requested() && frame < 100; ++frame) writer.write(test::sampleFrame(frame));
    });
    const BackupResult result = backUpAt(kLongAgo);
    others.request_stop();
    others.join();
    ASSERT_EQ(result.outcome, BackupOutcome::made) << result.notice;
    ProjectFile project = ProjectFile::open(result.backup->path, ProjectFile::Mode::read_only);
    const auto run = RunStore(project).run(writer.runId());
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->state, RunState::stopped);
    ASSERT_GE(run->frames_done, 1);
    test::expectSame(*RunStore(project).frameResult(writer.runId(), 0), test::sampleFrame(0, kLarge));
    EXPECT_EQ(RunStore(project).frameSummaries(writer.runId()).back().frame, run->frames_done - 1);
    ProjectFile original = ProjectFile::open(path_);
    EXPECT_EQ(RunStore(original).run(writer.runId())->state, RunState::running) << "the project itself is untouched";
}

TEST_F(BackupTest, IsMadeOnceADayAndOnlyOfWhatChanged) {
    test::writeSampleProject(path_, 1);
    EXPECT_EQ(backUpIfDue(path_, {}, kLongAgo).outcome, BackupOutcome::made);
    EXPECT_EQ(backUpIfDue(path_, {}, kLongAgo + 10h).outcome, BackupOutcome::not_due);
    EXPECT_EQ(backUpIfDue(path_, {}, kLongAgo + 20h).outcome, BackupOutcome::made) << "the next day by UTC";
    const UtcTime tomorrow = utcNow() + 24h;
    EXPECT_EQ(backUpIfDue(path_, {}, tomorrow).outcome, BackupOutcome::made);
    EXPECT_EQ(backUpIfDue(path_, {}, tomorrow + 24h).outcome, BackupOutcome::not_due) << "nothing changed since";
    EXPECT_EQ(listBackups(path_).size(), 3U);
}

TEST_F(BackupTest, IsNotMadeOfNothing) {
    EXPECT_EQ(backUpIfDue(path_).outcome, BackupOutcome::not_due);
    ProjectFile::create(path_);
    EXPECT_EQ(backUpIfDue(path_).outcome, BackupOutcome::not_due);
    EXPECT_TRUE(listBackups(path_).empty());
}

TEST_F(BackupTest, KeepsTheNewestFiveOfThisProject) {
    test::writeSampleProject(path_, 1);
    const auto other = folder_ / "other.eyrie";
    test::writeSampleProject(other, 1);
    ASSERT_EQ(backUpIfDue(other, {}, kLongAgo - 48h).outcome, BackupOutcome::made);
    for (int day = 0; day < 8; ++day) {
        ASSERT_EQ(backUpIfDue(path_, {}, kLongAgo + 24h * day).outcome, BackupOutcome::made) << day;
    }
    const auto kept = listBackups(path_);
    ASSERT_EQ(kept.size(), 5U);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(kept[static_cast<std::size_t>(i)].made, kLongAgo + 24h * (7 - i));
    EXPECT_EQ(files().size(), 5U);
    EXPECT_EQ(listBackups(other).size(), 1U);
}

TEST_F(BackupTest, TwoInOneSecondAreBothKept) {
    test::writeSampleProject(path_, 1);
    EXPECT_EQ(backUpAt(kLongAgo).outcome, BackupOutcome::made);
    EXPECT_EQ(backUpAt(kLongAgo).outcome, BackupOutcome::made);
    EXPECT_EQ(listBackups(path_).size(), 2U);
}

TEST_F(BackupTest, TwoProgramsMakeOneTogether) {
    test::writeSampleProject(path_, 20, kLarge);
    std::vector<pid_t> children;
    for (int i = 0; i < 4; ++i) {
        const pid_t child = fork();
        if (child == 0) {
            const BackupResult result = backUpIfDue(path_, {}, kLongAgo);
            _exit(result.outcome == BackupOutcome::impossible || !result.notice.empty() ? 1 : 0);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
    }
    EXPECT_EQ(files().size(), 1U);
}

TEST_F(BackupTest, AKillHalfwayLeavesNothingThatCounts) {
    test::writeSampleProject(path_, 20, kLarge);
    const pid_t child = fork();
    if (child == 0) {
        BackupRequest request;
        request.watch.progress = [](double share) {
            if (share > 0.3) kill(getpid(), SIGKILL);
        };
        backUp(path_, request);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it was to be killed halfway";
    EXPECT_TRUE(listBackups(path_).empty());
    EXPECT_FALSE(files().empty()) << "the half copy";
    EXPECT_EQ(backUpAt(kLongAgo).outcome, BackupOutcome::made);
    EXPECT_EQ(files().size(), 1U) << "what the kill left is gone";
}

TEST_F(BackupTest, CanBeStopped) {
    test::writeSampleProject(path_, 20, kLarge);
    std::stop_source stop;
    BackupRequest request;
    request.watch = {[&](double) { stop.request_stop(); }, stop.get_token()};
    EXPECT_EQ(backUp(path_, request).outcome, BackupOutcome::stopped);
    EXPECT_TRUE(files().empty());
}

TEST_F(BackupTest, AFullDiskIsToldAndLeavesNothing) {
    test::writeSampleProject(path_, 20, kLarge);
    const pid_t child = fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1'000'000, 1'000'000};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(98);
        const BackupResult result = backUpIfDue(path_, {}, kLongAgo);
        const bool told = result.notice.find(path_.string()) != std::string::npos;
        _exit(result.outcome == BackupOutcome::impossible && told ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(files().empty());
    EXPECT_EQ(integrity(), "ok");
}

TEST_F(BackupTest, AFolderThatCannotBeWrittenIsTold) {
    test::writeSampleProject(path_, 1);
    std::ofstream(folder_ / ".eyrie-backups") << "in the way";
    const BackupResult result = backUpIfDue(path_);
    EXPECT_EQ(result.outcome, BackupOutcome::impossible);
    EXPECT_THAT(result.notice, HasSubstr((folder_ / ".eyrie-backups").string()));
}

TEST_F(BackupTest, ADamagedProjectDoesNotPushOutGoodCopies) {
    test::writeSampleProject(path_, 20, kLarge);
    ASSERT_EQ(backUpIfDue(path_, {}, kLongAgo).outcome, BackupOutcome::made);
    {
        std::fstream file(path_, std::ios::binary | std::ios::in | std::ios::out);
        // Behind the schema, without which nothing is left of it.
        file.seekp(8192 * 80);
        file << std::string(8192 * 40, '\x5a');
    }
    const BackupResult result = backUpIfDue(path_, {}, kLongAgo + 24h);
    EXPECT_EQ(result.outcome, BackupOutcome::impossible);
    EXPECT_THAT(result.notice, HasSubstr("damaged"));
    EXPECT_EQ(files().size(), 1U);
    EXPECT_EQ(backUpAt(kLongAgo + 25h).outcome, BackupOutcome::made) << "before restoring it is kept as it is";
}

TEST_F(BackupTest, AnOlderProjectIsKeptBeforeItIsMigrated) {
    std::ifstream file(test::sourceFolder() / "tests/data/schema_1.sql");
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    SQLite::Database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec(text);
    EXPECT_EQ(ProjectFile::open(path_).notice(), "");
    const auto kept = listBackups(path_);
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_EQ(kept[0].reason, BackupReason::before_migration);
    {
        SQLite::Database copy(kept[0].path.string(), SQLite::OPEN_READONLY);
        EXPECT_EQ(schema::numberOf(copy), 1);
    }
    EXPECT_EQ(contentsOf(kept[0].path).runs.size(), 1U);
    EXPECT_EQ(files().size(), 1U) << "looking at it leaves nothing beside it";
    // Opened again, nothing is migrated and nothing kept; the kept state itself is never written.
    ProjectFile::open(path_);
    EXPECT_THROW(ProjectFile::open(kept[0].path), Error);
    EXPECT_EQ(files().size(), 1U);
    const auto copy = folder_ / "copy.eyrie";
    std::filesystem::copy_file(kept[0].path, copy);
    std::filesystem::permissions(copy, std::filesystem::perms::owner_all);
    ProjectFile project = ProjectFile::open(copy);
    EXPECT_TRUE(RunStore(project).frameResult(1, 7).has_value());
}

TEST_F(BackupTest, WithoutRoomForACopyAnOlderProjectOpensAllTheSame) {
    std::ifstream file(test::sourceFolder() / "tests/data/schema_1.sql");
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    SQLite::Database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec(text);
    std::ofstream(folder_ / ".eyrie-backups") << "in the way";
    ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
    EXPECT_THAT(project.notice(), HasSubstr("no copy"));
    EXPECT_EQ(RunStore(project).runs().size(), 1U);
}

}  // namespace
}  // namespace eyrie::project_backup_test
