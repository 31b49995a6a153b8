#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <thread>

#include "core/error.h"
#include "core/values/last_frame.h"
#include "store/health/project_check.h"
#include "store/runs/result_writer.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::killed_run_test {
namespace {

/// Writes frames until it is killed, and tells the pipe of each that was written.
[[noreturn]] void writeUntilKilled(const std::filesystem::path& path, const RunRecord& run, int pipe_end) {
    try {
        ResultWriter writer(path, run, {});
        for (int frame = 0;; ++frame) {
            writer.write(test::sampleFrame(frame));
            const char message = 1;
            if (write(pipe_end, &message, 1) != 1) break;
        }
    } catch (...) {
    }
    _exit(1);
}

/// Starts a writer and kills it a moment after it has reported `frames` frames; answers how many it reported.
int killAfter(const std::filesystem::path& path, int frames, std::chrono::microseconds moment,
              const RunRecord& run = test::sampleRun()) {
    int ends[2];
    if (pipe(ends) != 0) return -1;
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        writeUntilKilled(path, run, ends[1]);
    }
    close(ends[1]);
    int reported = 0;
    char message = 0;
    while (reported < frames && read(ends[0], &message, 1) == 1) ++reported;
    // The moment decides where inside the next frame the axe falls; any is right.
    std::this_thread::sleep_for(moment);
    kill(child, SIGKILL);
    while (read(ends[0], &message, 1) == 1) ++reported;
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return reported;
}

TEST(KilledRun, KeepsEveryWrittenFrameWhole) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    ProjectFile::create(path);
    std::mt19937 dice(11);
    for (int round = 1; round <= 12; ++round) {
        const int wanted = static_cast<int>(dice() % 25);
        const int reported = killAfter(path, wanted, std::chrono::microseconds(dice() % 4000));
        ASSERT_GE(reported, wanted) << "the writer ended by itself";
        ProjectFile project = ProjectFile::open(path);
        const RunStore store(project);
        const auto runs = store.runs();
        // With no frame reported the run itself may have come too late; then earlier runs stay as they were.
        if (runs.empty() || reported == 0) continue;
        const RunRecord& run = runs.back();
        EXPECT_EQ(run.state, RunState::running);
        EXPECT_GE(run.frames_done, reported) << "a written frame is missing";
        EXPECT_LE(run.frames_done, reported + 1);
        const auto summaries = store.frameSummaries(run.id);
        ASSERT_EQ(static_cast<int>(summaries.size()), run.frames_done);
        for (int frame = 0; frame < run.frames_done; ++frame) {
            const auto result = store.frameResult(run.id, frame);
            ASSERT_TRUE(result.has_value());
            test::expectSame(*result, test::sampleFrame(frame));
        }
        EXPECT_FALSE(store.frameResult(run.id, run.frames_done).has_value());
        const auto later = store.trackStatesUpTo(run.id, 1'000'000, 1'000'000 - run.frames_done + 1);
        EXPECT_TRUE(later.empty()) << "states of a frame that is not there";
    }
}

/// As a live source gives it: nobody knows before when it ends.
RunRecord runWithoutEnd() {
    RunRecord run = test::sampleRun();
    run.sequence.frame_count = kLastFrame + 1;
    run.last_frame = kLastFrame;
    return run;
}

TEST(KilledRun, WithoutAPlannedEndEndsAtItsLastFrame) {
    std::mt19937 dice(12);
    for (int round = 1; round <= 6; ++round) {
        const test::TemporaryFolder folder;
        const auto path = folder / "clip.eyrie";
        ProjectFile::create(path);
        const int wanted = 1 + static_cast<int>(dice() % 20);
        ASSERT_GE(killAfter(path, wanted, std::chrono::microseconds(dice() % 4000), runWithoutEnd()), wanted);
        ProjectFile project = ProjectFile::open(path);
        const RunRecord run = RunStore(project).runs().back();
        ASSERT_GE(run.frames_done, wanted);
        EXPECT_EQ(run.last_frame, run.frames_done - 1);
        EXPECT_EQ(run.sequence.frame_count, run.frames_done);
    }
}

TEST(KilledRun, WithoutAPlannedEndAndBeforeItsFirstFrameHasNone) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    ProjectFile::create(path);
    // It goes without an end being written, as in a kill.
    { const ResultWriter writer(path, runWithoutEnd(), {}); }
    ProjectFile project = ProjectFile::open(path);
    const RunRecord run = RunStore(project).runs().at(0);
    EXPECT_EQ(run.frames_done, 0);
    EXPECT_EQ(run.last_frame, run.first_frame - 1);
    EXPECT_EQ(run.sequence.frame_count, 0);
    EXPECT_EQ(stateNow(run), RunState::stopped);
    EXPECT_TRUE(checkProject(path).healthy());
}

TEST(WorkingRun, WithoutAPlannedEndReachesAsFarAsItsFramesAtAnyMoment) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    ProjectFile project = ProjectFile::create(path);
    const RunStore store(project);
    ResultWriter writer(path, runWithoutEnd(), {});
    for (int frame = 0; frame < 3; ++frame) {
        writer.write(test::sampleFrame(frame));
        const RunRecord run = store.run(writer.runId()).value();
        EXPECT_EQ(run.last_frame, frame);
        EXPECT_EQ(run.sequence.frame_count, frame + 1);
    }
    writer.finish(RunState::finished, "");
    ResultWriter planned(path, test::sampleRun(), {});
    planned.write(test::sampleFrame(0));
    EXPECT_EQ(store.run(planned.runId())->last_frame, test::sampleRun().last_frame) << "what is planned stays";
}

TEST(WorkingRun, IsReadByOthersMeanwhile) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    ProjectFile::create(path);
    ResultWriter writer(path, test::sampleRun(), {});
    writer.write(test::sampleFrame(0));
    constexpr int kFrames = 120;
    const auto follow = [&](ProjectFile::Mode mode) {
        ProjectFile project = ProjectFile::open(path, mode);
        const RunStore store(project);
        for (int done = 1; done < kFrames;) {
            const int now = store.run(writer.runId())->frames_done;
            ASSERT_GE(now, done);
            done = now;
            const auto result = store.frameResult(writer.runId(), done - 1);
            ASSERT_TRUE(result.has_value());
            test::expectSame(*result, test::sampleFrame(done - 1));
        }
    };
    {
        std::jthread first(follow, ProjectFile::Mode::read_only);
        std::jthread second(follow, ProjectFile::Mode::read_write);
        for (int frame = 1; frame < kFrames; ++frame) writer.write(test::sampleFrame(frame));
    }
    writer.finish(RunState::finished, "");
}

TEST(WorkingRun, LetsOthersWriteMeanwhile) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    const int earlier = test::writeSampleProject(path, 3);
    ResultWriter writer(path, test::sampleRun(), {});
    ProjectFile project = ProjectFile::open(path);
    RunStore store(project);
    writer.write(test::sampleFrame(0));
    store.rename(earlier, "kept");
    writer.write(test::sampleFrame(1));
    store.remove(earlier);
    writer.write(test::sampleFrame(2));
    EXPECT_EQ(store.run(writer.runId())->frames_done, 3);
}

TEST(WorkingRun, ThatIsRemovedIsTold) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    ProjectFile project = ProjectFile::create(path);
    ResultWriter writer(path, test::sampleRun(), {});
    writer.write(test::sampleFrame(0));
    project.database().exec("DELETE FROM run");  // as another tool might
    try {
        writer.write(test::sampleFrame(1));
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::project) << error.what();
        EXPECT_NE(std::string(error.what()).find("removed"), std::string::npos) << error.what();
    }
}

TEST(WorkingRun, RefusesAFrameTwiceAndGoesOn) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    ProjectFile project = ProjectFile::create(path);
    ResultWriter writer(path, test::sampleRun(), {});
    writer.write(test::sampleFrame(0));
    EXPECT_THROW(writer.write(test::sampleFrame(0)), Error);
    writer.write(test::sampleFrame(1));
    EXPECT_EQ(RunStore(project).run(writer.runId())->frames_done, 2);
    EXPECT_EQ(RunStore(project).tracks(writer.runId())[0].frames, 2) << "the refused frame left no trace";
}

TEST(WorkingRun, NeedsAProject) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(ResultWriter(folder / "none.eyrie", test::sampleRun(), {}), Error);
}

}  // namespace
}  // namespace eyrie::killed_run_test
