#include "chain/recording/run_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "store/project/project_file.h"
#include "support/moving_scene.h"
#include "support/temporary_folder.h"

namespace eyrie::run_recorder_test {
namespace {

struct StopAfter : ChainObserver {
    std::stop_source stop;
    int frames;
    explicit StopAfter(int count) : frames(count) {}
    void onFrame(const std::shared_ptr<const FrameResult>&, const Frame&) override {
        if (--frames == 0) stop.request_stop();
    }
};

RunRecord record(const std::filesystem::path& project, test::MemorySource& source, int stop_after,
                 FrameRange range = {}) {
    const SceneScale scale = sceneScale(source.info(), 0.2);
    StopAfter stopper(stop_after);
    RunRecorder recorder(project, plannedRun(source.info(), scale, range, "default"), ChainOptions{}, &stopper);
    return recorder.finish(ChainRun(ChainOptions{}, scale).run(source, range, recorder, stopper.stop.get_token()));
}

RunRecord record(const std::filesystem::path& project, int stop_after) {
    test::MemorySource source((test::MovingScene()));
    return record(project, source, stop_after);
}

/// Somebody still writes it.
struct GrowingSource : test::MemorySource {
    using MemorySource::MemorySource;
    bool hasGrown() const noexcept override { return true; }
};

/// Whose clock was set while it was recorded.
struct LeapingSource : test::MemorySource {
    using MemorySource::MemorySource;
    std::int64_t timeOf(FrameIndex index) const override {
        return MemorySource::timeOf(index) + (index < 5 ? 0 : 60'000'000);
    }
};

/// Whose pictures are counted, and may be gone once the run is over.
struct CountedSource : test::MemorySource {
    using MemorySource::MemorySource;
    int reads = 0;
    bool gone = false;
    Frame read(FrameIndex index, bool with_colour) override {
        ++reads;
        if (gone) throw Error(ErrorKind::input, "gone");
        return MemorySource::read(index, with_colour);
    }
};

struct Finished {
    RunRecord record;
    int reads = 0;  ///< while it was finished
};

Finished finishedWith(const std::filesystem::path& project, int stop_after, bool gone) {
    test::MovingScene scene;
    scene.frames = 60;
    CountedSource source(scene);
    const SceneScale scale = sceneScale(source.info(), 0.2);
    StopAfter stopper(stop_after);
    RunRecorder recorder(project, plannedRun(source.info(), scale, {}, "default"), ChainOptions{}, &stopper);
    const RunSummary summary = ChainRun(ChainOptions{}, scale).run(source, {}, recorder, stopper.stop.get_token());
    source.reads = 0;
    source.gone = gone;
    Finished finished;
    finished.record = recorder.finish(summary, &source);
    finished.reads = source.reads;
    return finished;
}

}  // namespace

TEST(RunRecorder, picturesAreReadOnceMoreWhereTheRunIsWhole) {
    const test::TemporaryFolder folder;
    const Finished whole = finishedWith(folder / "whole.eyrie", 1000, false);
    EXPECT_EQ(whole.record.state, RunState::finished);
    EXPECT_GT(whole.reads, 0);
    EXPECT_LE(whole.reads, 60);
    EXPECT_EQ(finishedWith(folder / "stopped.eyrie", 50, false).reads, 0) << "whoever stops does not wait";
    const Finished gone = finishedWith(folder / "gone.eyrie", 1000, true);
    EXPECT_EQ(gone.record.state, RunState::finished);
    EXPECT_EQ(gone.record.message,
              std::to_string(gone.reads) + " pictures could not be read again to finish the tracks");
}

TEST(RunRecorder, aStopWhilePicturesAreReadOnceMoreLeavesAStoppedRun) {
    const test::TemporaryFolder folder;
    test::MovingScene scene;
    scene.frames = 60;
    CountedSource source(scene);
    const SceneScale scale = sceneScale(source.info(), 0.2);
    RunRecord run;
    {
        RunRecorder recorder(folder / "p.eyrie", plannedRun(source.info(), scale, {}, "default"), ChainOptions{});
        const RunSummary summary = ChainRun(ChainOptions{}, scale).run(source, {}, recorder, {});
        std::stop_source stop;
        stop.request_stop();
        run = recorder.finish(summary, &source, stop.get_token());
    }
    EXPECT_EQ(run.state, RunState::stopped);
    EXPECT_EQ(run.frames_done, 60);
    EXPECT_EQ(run.message, "stopped while its tracks were finished");
    const ResumedRun resumed = resumedRun(folder / "p.eyrie", run.id, source);
    RunRecorder again(folder / "p.eyrie", resumed);
    const RunSummary rest =
        ChainRun(resumed.options, scale).run(source, resumed.range(), again, {}, false, resumed.start);
    EXPECT_EQ(again.finish(rest, &source).state, RunState::finished);
}

TEST(RunRecorder, aFinishedRunIsShownAgainWithoutTheVideo) {
    const test::TemporaryFolder folder;
    const RunRecord run = record(folder / "p.eyrie", 1000);
    EXPECT_EQ(run.state, RunState::finished);
    EXPECT_EQ(run.frames_done, 40);
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    const RunStore store(project);
    const auto result = store.frameResult(run.id, 30);
    ASSERT_TRUE(result);
    EXPECT_FALSE(result->motion.motion_vectors.empty());
    EXPECT_FALSE(result->motion.stationary_corners.empty());
    EXPECT_FALSE(result->clusters.empty());
    EXPECT_FALSE(result->detections.empty());
    EXPECT_FALSE(result->tracks.empty());
    EXPECT_EQ(store.parameters(run.id), parameterValues(ChainOptions{}));
}

TEST(RunRecorder, aStoppedRunKeepsItsFramesAndASecondRunIsAdded) {
    const test::TemporaryFolder folder;
    const RunRecord stopped = record(folder / "p.eyrie", 25);
    EXPECT_EQ(stopped.state, RunState::stopped);
    EXPECT_EQ(stopped.frames_done, 25);
    const RunRecord second = record(folder / "p.eyrie", 1000);
    EXPECT_NE(second.id, stopped.id);
    EXPECT_EQ(second.sequence.id, stopped.sequence.id);
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    EXPECT_EQ(RunStore(project).runs().size(), 2U);
    EXPECT_FALSE(RunStore(project).trackBoxes(stopped.id).empty());
}

TEST(RunRecorder, aRunToTheEndOfAVideoThatHasGrownMeanwhileSaysSo) {
    const test::TemporaryFolder folder;
    test::MovingScene scene;
    scene.frames = 8;
    GrowingSource source(scene);
    const RunRecord run = record(folder / "p.eyrie", source, 1000);
    EXPECT_EQ(run.state, RunState::finished);
    EXPECT_EQ(run.message,
              "the video has grown since it was opened; the run ends with frame 7, which was the last one then; "
              "open it again and make a run over the rest");
    EXPECT_EQ(record(folder / "p.eyrie", source, 1000, {0, 5}).message, "") << "whoever asks for a part has that";
    EXPECT_EQ(record(folder / "p.eyrie", source, 3).message, "");
}

TEST(RunRecorder, aClockThatLeapsAheadIsToldWithItsFrame) {
    const test::TemporaryFolder folder;
    test::MovingScene scene;
    scene.frames = 8;
    LeapingSource source(scene);
    EXPECT_THAT(record(folder / "p.eyrie", source, 1000).message,
                testing::HasSubstr("leaps ahead by 1:00 before frame 5"));
    EXPECT_EQ(record(folder / "p.eyrie", source, 1000, {0, 4}).message, "");
    EXPECT_EQ(record(folder / "p.eyrie", source, 1000, {5, 7}).message, "");
}

}  // namespace eyrie::run_recorder_test
