#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "store/health/file_check.h"
#include "store/runs/result_writer.h"
#include "store/runs/run_lock.h"
#include "store/samples.h"
#include "store/sweeps/sweep_store.h"
#include "support/child.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

/// Several programs, or several connections of one, on one project.
namespace eyrie::shared_project_test {
namespace {

using test::messageOf;
using testing::HasSubstr;

class SharedProject : public testing::Test {
 protected:
    /// Whether another process finds a lock on the project's file.
    bool lockedForOthers() {
        return test::inChild([this] {
                   const int file = open(path_.c_str(), O_RDWR);
                   struct flock range {};
                   range.l_type = F_WRLCK;
                   range.l_whence = SEEK_SET;
                   if (fcntl(file, F_GETLK, &range) != 0) return 2;
                   return range.l_type == F_UNLCK ? 0 : 1;
               }) == 1;
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
};

TEST_F(SharedProject, StaysLockedHoweverOftenItIsOpenedAndLookedAt) {
    const ProjectFile held = ProjectFile::create(path_);
    ASSERT_TRUE(lockedForOthers());
    ProjectFile::open(path_);
    EXPECT_TRUE(lockedForOthers()) << "opened a second time";
    ProjectFile::open(path_, ProjectFile::Mode::read_only);
    EXPECT_TRUE(lockedForOthers()) << "read";
    checkFile(path_);
    EXPECT_TRUE(isProject(path_));
    std::filesystem::create_hard_link(path_, folder_ / "other_name");
    EXPECT_TRUE(isProject(folder_ / "other_name"));
    EXPECT_TRUE(lockedForOthers()) << "looked at";
}

TEST_F(SharedProject, ARunIsAddedOnlyIfNobodyAddedOneMeanwhile) {
    ProjectFile::create(path_);
    const MayAddRun if_first = [](const RunStore& store) {
        const std::vector<RunRecord> runs = store.runs();
        if (!runs.empty()) throw Error(ErrorKind::project, "begun by " + runs.front().writer);
    };
    const ResultWriter first(path_, test::sampleRun(), {}, if_first);
    EXPECT_THAT(messageOf(ErrorKind::project, [&] { ResultWriter(path_, test::sampleRun(), {}, if_first); }),
                HasSubstr("begun by process " + std::to_string(getpid())))
        << "it is seen as soon as it is there, with who writes it";
    ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
    EXPECT_EQ(RunStore(project).runs().size(), 1U);
    ResultWriter(path_, test::sampleRun(), {});
    EXPECT_EQ(RunStore(project).runs().size(), 2U) << "who does not ask may";
}

TEST_F(SharedProject, ASecondProgramThatEndsLeavesTheLogOfTheFirst) {
    ProjectFile first = ProjectFile::create(path_);
    ProjectFile::open(path_);
    const int run = [&] {
        ResultWriter writer(path_, test::sampleRun(), {});
        writer.write(test::sampleFrame(0));
        return writer.runId();
    }();
    const auto second = [this] { return test::inChild([this] { return ProjectFile::open(path_), 0; }); };
    ASSERT_EQ(second(), 0);
    RunStore(first).rename(run, "after");
    // What the first wrote after the second had ended is what a third reads.
    EXPECT_EQ(test::inChild([&] {
                  ProjectFile third = ProjectFile::open(path_, ProjectFile::Mode::read_only);
                  return RunStore(third).run(run)->name == "after" ? 0 : 1;
              }),
              0);
}

TEST_F(SharedProject, ANewOneDoesNotTakeOverTheLogOfADeletedOne) {
    // A killed program leaves its log …
    EXPECT_EQ(test::inChild([this] {
                  ProjectFile::create(path_);
                  ResultWriter writer(path_, test::sampleRun(), {});
                  for (int frame = 0; frame < 5; ++frame) writer.write(test::sampleFrame(frame));
                  return kill(getpid(), SIGKILL);
              }),
              -1);
    ASSERT_TRUE(hasLog(path_));
    // … and only the project itself is deleted.
    std::filesystem::remove(path_);
    ProjectFile project = ProjectFile::create(path_);
    EXPECT_TRUE(RunStore(project).runs().empty());
    EXPECT_EQ(project.database().execAndGet("PRAGMA integrity_check").getString(), "ok");
    int kept = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
        kept += entry.path().filename().string().find("-wal.left-") != std::string::npos;
    EXPECT_EQ(kept, 1) << "somebody's work may be in it";
}

TEST_F(SharedProject, OfManyThatMakeItAtOnceAllWorkOnTheSame) {
    constexpr int kPrograms = 6;
    std::vector<pid_t> children;
    for (int i = 0; i < kPrograms; ++i) {
        const pid_t child = fork();
        if (child == 0) {
            int code = 1;
            try {
                ProjectFile::openOrCreate(path_);
                ResultWriter writer(path_, test::sampleRun(), {});
                writer.write(test::sampleFrame(0));
                writer.finish(RunState::finished, "");
                code = 0;
            } catch (const std::exception& error) {
                std::fprintf(stderr, "%s\n", error.what());
            }
            _exit(code);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
    }
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_THAT(RunStore(project).runs(), testing::SizeIs(kPrograms));
}

TEST_F(SharedProject, AFileThatAnotherMadeMeanwhileIsNotReplaced) {
    std::ofstream(path_) << "mine";
    EXPECT_THAT(messageOf(ErrorKind::output, [&] { ProjectFile::create(path_); }), HasSubstr("exists already"));
    EXPECT_EQ(std::filesystem::file_size(path_), 4U);
    const auto link = folder_ / "dangling.eyrie";
    std::filesystem::create_symlink(folder_ / "nowhere", link);
    EXPECT_THAT(messageOf(ErrorKind::output, [&] { ProjectFile::create(link); }), HasSubstr("exists already"));
}

TEST_F(SharedProject, WritersSayThatTheirFileWasTakenAway) {
    ProjectFile project = ProjectFile::create(path_);
    ResultWriter writer(path_, test::sampleRun(), {});
    writer.write(test::sampleFrame(0));
    const int sweep = SweepStore(project).add("", 1, "{}");
    std::filesystem::rename(path_, folder_ / "elsewhere.eyrie");
    EXPECT_THAT(messageOf(ErrorKind::project, [&] { writer.write(test::sampleFrame(1)); }), HasSubstr("moved"));
    EXPECT_THAT(messageOf(ErrorKind::project, [&] { SweepStore(project).addPoint(sweep, {}); }), HasSubstr("moved"));
    ProjectFile::create(path_);
    EXPECT_THAT(messageOf(ErrorKind::project, [&] { writer.write(test::sampleFrame(1)); }), HasSubstr("replaced"));
}

TEST_F(SharedProject, ARunIsLiveWhileItsProgramLives) {
    ProjectFile project = ProjectFile::create(path_);
    const RunStore store(project);
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        ResultWriter writer(path_, test::sampleRun(), {});
        [[maybe_unused]] const auto told = write(ends[1], "x", 1);
        for (;;) pause();
    }
    char told = 0;
    ASSERT_EQ(read(ends[0], &told, 1), 1);
    const RunRecord working = store.run(1).value();
    EXPECT_TRUE(working.live);
    EXPECT_THAT(working.writer, HasSubstr("process " + std::to_string(child)));
    EXPECT_THAT(messageOf(ErrorKind::project, [&] { RunStore(project).remove(1); }), HasSubstr(working.writer));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const RunRecord killed = store.run(1).value();
    EXPECT_EQ(killed.state, RunState::running);
    EXPECT_FALSE(killed.live);
    ASSERT_TRUE(std::filesystem::exists(runLockFile(path_, 1)));
    ResultWriter next(path_, test::sampleRun(), {});
    EXPECT_FALSE(std::filesystem::exists(runLockFile(path_, 1))) << "the next one tidies up";
}

TEST_F(SharedProject, ARemovedRunComesBackUntilItIsPurged) {
    const int first = test::writeSampleProject(path_, 3);
    const int second = test::writeSampleProject(path_, 2);
    ProjectFile project = ProjectFile::open(path_);
    RunStore store(project);
    store.remove(first);
    EXPECT_FALSE(store.run(first).has_value());
    EXPECT_THAT(store.runs(), testing::SizeIs(1));
    ASSERT_TRUE(store.lastRemoved().has_value());
    EXPECT_EQ(store.lastRemoved()->id, first);
    store.remove(second);
    project.database().exec("UPDATE run SET removed_utc = '2026-01-02T03:04:05Z' WHERE id = " + std::to_string(second));
    EXPECT_EQ(store.lastRemoved()->id, first) << "the one removed last, not the newest run";
    store.restore(second);
    store.restore(first);
    EXPECT_EQ(store.run(first)->frames_done, 3);
    store.remove(second);
    store.purgeRemoved();
    EXPECT_FALSE(store.lastRemoved().has_value());
    EXPECT_THAT(messageOf(ErrorKind::project, [&] { store.restore(second); }), HasSubstr("has no run"));
    test::expectSame(*store.frameResult(first, 2), test::sampleFrame(2));
}

TEST_F(SharedProject, ANameAsLongAsFileSystemsAllowIsANameToo) {
    const auto longest = folder_ / (std::string(245, 'n') + ".eyrie");  // 251; SQLite adds four
    ProjectFile::create(longest);
    ResultWriter writer(longest, test::sampleRun(), {});
    ProjectFile project = ProjectFile::open(longest);
    EXPECT_TRUE(RunStore(project).run(writer.runId())->live);
}

}  // namespace
}  // namespace eyrie::shared_project_test
