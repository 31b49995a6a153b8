#include "store/backup/project_restore.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "core/error.h"
#include "store/health/project_contents.h"
#include "store/labels/annotation_store.h"
#include "store/labels/label_samples.h"
#include "store/project/project_presets.h"
#include "store/runs/result_writer.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::project_restore_test {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr UtcTime kLongAgo = std::chrono::sys_days(std::chrono::year(2020) / 5 / 1) + 9h;

/// A project of one run and one labelled object, a copy of it, and then a second run, a preset and another object.
class RestoreTest : public testing::Test {
 protected:
    void SetUp() override {
        test::writeSampleProject(path_, 3);
        label();
        backup_ = *backUpIfDue(path_, {}, kLongAgo).backup;
        test::writeSampleProject(path_, 2);
        label();
        ProjectFile project = ProjectFile::open(path_);
        savePreset(project, {"dusk", "", {{"gradient.quantile", "0.3"}}});
    }
    void label() const {
        ProjectFile project = ProjectFile::open(path_);
        AnnotationStore labels(project, 1);
        labels.apply(test::sampleEdit(labels.newObjectId()));
    }
    ProjectContents now() const { return contentsOf(path_); }
    std::vector<std::string> differencesTo(const ProjectBackup& backup) const {
        return differencesInWords(now(), contentsOf(backup.path));
    }
    ino_t inode() const {
        struct stat facts {};
        stat(path_.c_str(), &facts);
        return facts.st_ino;
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
    ProjectBackup backup_;
};

TEST_F(RestoreTest, TellsWhatDiffersFirst) {
    EXPECT_THAT(differencesTo(backup_),
                testing::ElementsAre(testing::AllOf(HasSubstr("run 2"), HasSubstr("would be gone")),
                                     "1 labelled object would be gone", "4 keyframes in place of 8",
                                     "1 step to undo in place of 2", "preset \"dusk\" would be gone"));
    EXPECT_TRUE(differencesInWords(now(), now()).empty());
}

TEST_F(RestoreTest, BringsTheEarlierStateBackAndKeepsThePresentOne) {
    const ProjectContents before = now();
    const ino_t file = inode();
    const BackupResult result = restoreBackup(path_, backup_);
    ASSERT_EQ(result.outcome, BackupOutcome::made) << result.notice;
    EXPECT_EQ(result.backup->reason, BackupReason::before_restoring);
    EXPECT_EQ(inode(), file);
    EXPECT_TRUE(differencesTo(backup_).empty());
    EXPECT_TRUE(differencesInWords(before, contentsOf(result.backup->path)).empty());
    {
        ProjectFile project = ProjectFile::open(path_);
        test::expectSame(*RunStore(project).frameResult(1, 2), test::sampleFrame(2));
        EXPECT_EQ(project.database().execAndGet("PRAGMA journal_mode").getString(), "wal");
        EXPECT_EQ(project.database().execAndGet("PRAGMA integrity_check").getString(), "ok");
    }
    // And forward again.
    ASSERT_EQ(restoreBackup(path_, *result.backup).outcome, BackupOutcome::made);
    EXPECT_TRUE(differencesInWords(before, now()).empty());
}

TEST_F(RestoreTest, IsRefusedWhileTheProjectIsOpenElsewhere) {
    const ProjectContents before = now();
    for (const auto mode : {ProjectFile::Mode::read_only, ProjectFile::Mode::read_write}) {
        ProjectFile other = ProjectFile::open(path_, mode);
        try {
            restoreBackup(path_, backup_);
            FAIL() << "expected an error";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::project);
            EXPECT_THAT(error.what(), HasSubstr("open in another program or window"));
        }
        EXPECT_EQ(RunStore(other).runs().size(), 2U);
    }
    EXPECT_TRUE(differencesInWords(before, now()).empty());
    EXPECT_EQ(listBackups(path_).size(), 1U);
}

TEST_F(RestoreTest, IsRefusedWhileAnotherProgramHasItOpen) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        ProjectFile other = ProjectFile::open(path_);
        AnnotationStore labels(other, 1);
        if (write(ends[1], "x", 1) != 1) _exit(1);
        pause();
        _exit(0);
    }
    char ready = 0;
    ASSERT_EQ(read(ends[0], &ready, 1), 1);
    try {
        restoreBackup(path_, backup_);
        ADD_FAILURE() << "expected an error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("process " + std::to_string(child))) << "who has it";
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_EQ(restoreBackup(path_, backup_).outcome, BackupOutcome::made);
}

TEST_F(RestoreTest, AKillHalfwayLeavesThePresentState) {
    ProjectFile::create(folder_ / "large.eyrie");
    const auto path = folder_ / "large.eyrie";
    const test::SampleSize large{20000, 3000, 20, 20, 20, {768, 576}};
    test::writeSampleProject(path, 20, large);
    const ProjectBackup backup = *backUpIfDue(path, {}, kLongAgo).backup;
    test::writeSampleProject(path, 3);
    const ProjectContents before = contentsOf(path);
    const pid_t child = fork();
    if (child == 0) {
        CopyWatch watch;
        watch.progress = [](double share) {
            if (share > 0.5) kill(getpid(), SIGKILL);
        };
        restoreBackup(path, backup, watch);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it was to be killed halfway";
    ProjectFile project = ProjectFile::open(path);
    EXPECT_EQ(project.database().execAndGet("PRAGMA integrity_check").getString(), "ok");
    EXPECT_TRUE(differencesInWords(before, contentsOf(path)).empty());
}

TEST_F(RestoreTest, StoppedHalfwayItChangesNothing) {
    const ProjectContents before = now();
    std::stop_source stop;
    const CopyWatch watch{[&](double) { stop.request_stop(); }, stop.get_token()};
    const BackupResult result = restoreBackup(path_, backup_, watch);
    // A copy of a single step is done before it can be stopped.
    if (result.outcome == BackupOutcome::stopped) {
        EXPECT_TRUE(differencesInWords(before, now()).empty());
    }
    stop.request_stop();
    EXPECT_EQ(restoreBackup(path_, backup_, {{}, stop.get_token()}).outcome, BackupOutcome::stopped);
}

TEST_F(RestoreTest, NothingIsRestoredWhenThePresentStateCannotBeKept) {
    const ProjectContents before = now();
    const auto aside = folder_ / backup_.path.filename().string();
    std::filesystem::rename(backup_.path, aside);
    std::filesystem::remove_all(folder_ / ".eyrie-backups");
    std::ofstream(folder_ / ".eyrie-backups") << "in the way";
    ProjectBackup backup = backup_;
    backup.path = aside;
    EXPECT_THROW(restoreBackup(path_, backup), Error);
    EXPECT_TRUE(differencesInWords(before, now()).empty());
}

TEST_F(RestoreTest, AProjectThatIsGoneComesBack) {
    for (const char* ending : {"", "-wal", "-shm"}) std::filesystem::remove(path_.string() + ending);
    std::ofstream(path_.string() + "-wal") << "of the lost project";
    restoreBackup(path_, listBackups(path_).at(0));
    EXPECT_TRUE(differencesTo(backup_).empty());
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_EQ(RunStore(project).runs().size(), 1U);
}

TEST_F(RestoreTest, AsNewLeavesTheProjectAndReplacesNothing) {
    const ProjectContents before = now();
    const auto fresh = folder_ / "earlier.eyrie";
    EXPECT_TRUE(restoreAsNew(backup_, fresh));
    EXPECT_TRUE(differencesInWords(contentsOf(fresh), contentsOf(backup_.path)).empty());
    EXPECT_TRUE(differencesInWords(before, now()).empty());
    EXPECT_NO_THROW(ProjectFile::open(fresh)) << "it may be written, unlike the kept copy";
    EXPECT_THROW(restoreAsNew(backup_, path_), Error);
    EXPECT_TRUE(differencesInWords(before, now()).empty());
}

}  // namespace
}  // namespace eyrie::project_restore_test
