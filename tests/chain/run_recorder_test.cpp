#include "chain/recording/run_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/values/last_frame.h"
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
    bool leaps = false;  ///< its clock was set while it was recorded
    std::int64_t timeOf(FrameIndex index) const override {
        return MemorySource::timeOf(index) + (leaps && index >= 5 ? 60'000'000 : 0);
    }
    Frame read(FrameIndex index, bool with_colour) override {
        ++reads;
        if (gone) throw Error(ErrorKind::input, "gone");
        return MemorySource::read(index, with_colour);
    }
};

test::MovingScene sixtyFrames() {
    test::MovingScene scene;
    scene.frames = 60;
    return scene;
}

/// A run that was stopped after some frames and gone on with; how many pictures finishing it has read.
RunRecord finishedLater(const std::filesystem::path& project, bool gone, int& reads) {
    CountedSource source(sixtyFrames());
    const RunRecord stopped = record(project, source, 30);
    const ResumedRun resumed = resumedRun(project, stopped.id, source);
    RunRecorder recorder(project, resumed);
    recorder.holdPictures();
    const RunSummary summary =
        ChainRun(resumed.options, resumed.run.scale).run(source, resumed.range(), recorder, {}, false, resumed.start);
    source.reads = 0;
    source.gone = gone;
    const RunRecord finished = recorder.finish(summary, &source);
    reads = source.reads;
    return finished;
}

}  // namespace

TEST(RunRecorder, picturesOfAShortRunAreHeldAndNotReadOnceMore) {
    const test::TemporaryFolder folder;
    CountedSource source(sixtyFrames());
    const SceneScale scale = sceneScale(source.info(), 0.2);
    RunRecorder recorder(folder / "p.eyrie", plannedRun(source.info(), scale, {}, "default"), ChainOptions{});
    recorder.holdPictures();
    const RunSummary summary = ChainRun(ChainOptions{}, scale).run(source, {}, recorder, {});
    source.reads = 0;
    EXPECT_EQ(recorder.finish(summary, &source).state, RunState::finished);
    EXPECT_EQ(source.reads, 0);
}

TEST(RunRecorder, picturesThatAreNotHeldAreReadOnceMore) {
    const test::TemporaryFolder folder;
    int reads = 0;
    const RunRecord whole = finishedLater(folder / "whole.eyrie", false, reads);
    EXPECT_EQ(whole.state, RunState::finished);
    EXPECT_TRUE(whole.message.empty()) << whole.message;
    EXPECT_GT(reads, 0);
    EXPECT_LE(reads, 40) << "those before it was gone on with, and what its state is older";
    const RunRecord gone = finishedLater(folder / "gone.eyrie", true, reads);
    EXPECT_EQ(gone.state, RunState::finished);
    EXPECT_NE(gone.message.find("pictures could not be read again"), std::string::npos) << gone.message;
}

TEST(RunRecorder, lostPicturesAreToldBesideWhatElseThereIsToTell) {
    const test::TemporaryFolder folder;
    CountedSource source(sixtyFrames());
    source.leaps = true;
    const SceneScale scale = sceneScale(source.info(), 0.2);
    RunRecorder recorder(folder / "p.eyrie", plannedRun(source.info(), scale, {}, "default"), ChainOptions{});
    const RunSummary summary = ChainRun(ChainOptions{}, scale).run(source, {}, recorder, {});
    source.gone = true;
    const std::string message = recorder.finish(summary, &source).message;
    EXPECT_THAT(message, testing::HasSubstr("leaps ahead"));
    EXPECT_THAT(message, testing::ContainsRegex("[.] Also, [0-9]+ pictures could not be read again"));
}

/// A clock drawn into the picture is followed until it is known for what it is.
TEST(RunRecorder, leavesOutFromTheFirstFrameOnWhatTurnsOutToBeDrawnIntoThePictures) {
    const test::TemporaryFolder folder;
    test::MovingScene scene;
    scene.frames = 60;
    scene.camera_per_frame = {2.6, 1.2};
    scene.vehicles = {{{100, 120}, {4.6, 1.2}, {24, 11}}};
    test::MemorySource source(scene.frames, scene.size, [&](int frame) {
        cv::Mat picture = scene.draw(frame);
        cv::putText(picture, "12:03:" + std::to_string(10 + frame * 7 % 90), {20, 30}, cv::FONT_HERSHEY_SIMPLEX, 0.7,
                    cv::Scalar(255), 2, cv::LINE_AA);
        return picture;
    });
    const auto leftOut = [&](const ChainOptions& options, const std::string& name) {
        const SceneScale scale = sceneScale(source.info(), 0.2);
        RunRecorder recorder(folder / name, plannedRun(source.info(), scale, {}, "default"), options);
        const RunRecord run = recorder.finish(ChainRun(options, scale).run(source, {}, recorder, {}));
        ProjectFile project = ProjectFile::open(folder / name);
        int left_out = 0;
        for (FrameIndex frame = 0; frame < scene.frames; ++frame) {
            const auto stored = RunStore(project).frameResult(run.id, frame);
            for (const DroppedState& dropped : stored->dropped)
                left_out += dropped.why == TrackDrop::on_graphics && dropped.box.centre.y < 40;
        }
        return left_out;
    };
    EXPECT_GT(leftOut({}, "known.eyrie"), 0);
    ChainOptions options;
    options.registration.graphics.leave_out_graphics = false;
    EXPECT_EQ(leftOut(options, "unknown.eyrie"), 0);
}

TEST(RunRecorder, whoStopsARunDoesNotWaitForItsPictures) {
    const test::TemporaryFolder folder;
    CountedSource source(sixtyFrames());
    const SceneScale scale = sceneScale(source.info(), 0.2);
    StopAfter stopper(50);
    RunRecorder recorder(folder / "p.eyrie", plannedRun(source.info(), scale, {}, "default"), ChainOptions{}, &stopper);
    const RunSummary summary = ChainRun(ChainOptions{}, scale).run(source, {}, recorder, stopper.stop.get_token());
    source.gone = true;
    EXPECT_EQ(recorder.finish(summary, &source).state, RunState::stopped);
}

TEST(RunPictures, areHeldOnlyWhereAllOfThemTakeLittleMemory) {
    const cv::Mat picture(16, 16, CV_8UC1, cv::Scalar(7));
    constexpr int kMost = static_cast<int>(RunPictures::kMostBytes / (16 * 16));
    RunPictures fits({100, 100 + kMost - 1});
    fits.take(101, picture);
    EXPECT_EQ(fits.at(101).data, picture.data) << "held, not copied";
    EXPECT_TRUE(fits.at(99).empty());
    EXPECT_TRUE(fits.at(100).empty());
    EXPECT_TRUE(fits.at(102).empty());
    RunPictures too_many({100, 100 + kMost});
    too_many.take(101, picture);
    EXPECT_TRUE(too_many.at(101).empty());
    RunPictures open_end({0, kLastFrame});
    open_end.take(0, picture);
    EXPECT_TRUE(open_end.at(0).empty());
    RunPictures none;
    none.take(0, picture);
    EXPECT_TRUE(none.at(0).empty());
}

TEST(RunRecorder, aStopWhilePicturesAreReadOnceMoreLeavesAStoppedRun) {
    const test::TemporaryFolder folder;
    CountedSource source(sixtyFrames());
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
