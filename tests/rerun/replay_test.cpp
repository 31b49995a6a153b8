#include "rerun/replay.h"

#include <gtest/gtest.h>

#include "chain/recording/run_recorder.h"
#include "core/error.h"
#include "store/project/project_file.h"
#include "support/moving_scene.h"
#include "support/temporary_folder.h"

namespace eyrie::replay_test {
namespace {

/// A stored run over a small scene, and how to replay it.
class StoredRun {
 public:
    explicit StoredRun(const ChainOptions& options, int frames = 40) : options_(options) {
        scene_.frames = frames;
        source_ = std::make_unique<test::MemorySource>(scene_);
        scale_ = sceneScale(source_->info(), 0.2);
        RunRecorder recorder(path_, plannedRun(source_->info(), scale_, {}, "default"), options);
        recorder.finish(ChainRun(options, scale_).run(*source_, {}, recorder, {}));
        run_ = recorder.runId();
        project_ = std::make_unique<ProjectFile>(ProjectFile::open(path_));
    }
    ReplaySource replaySource() {
        ReplaySource replay;
        replay.options = storedOptions(RunStore(*project_).parameters(run_));
        replay.scale = scale_;
        replay.pixels = [this](FrameIndex frame) {
            ++frames_read;
            return source_->read(frame, false);
        };
        replay.motion_of = [this](FrameIndex frame) -> std::optional<FrameMotion> {
            auto result = RunStore(*project_).frameResult(run_, frame);
            if (!result) return std::nullopt;
            return std::move(result->motion);
        };
        return replay;
    }
    FrameResult stored(FrameIndex frame) const { return RunStore(*project_).frameResult(run_, frame).value(); }

    int frames_read = 0;

 private:
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "p.eyrie";
    ChainOptions options_;
    test::MovingScene scene_;
    std::unique_ptr<test::MemorySource> source_;
    SceneScale scale_;
    int run_ = 0;
    std::unique_ptr<ProjectFile> project_;
};

void expectSame(const OrientedBox& a, const OrientedBox& b) {
    EXPECT_EQ(a.centre, b.centre);
    EXPECT_EQ(a.length, b.length);
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.heading, b.heading);
}

void expectSame(const FrameResult& replayed, const FrameResult& stored) {
    ASSERT_EQ(replayed.clusters.size(), stored.clusters.size());
    ASSERT_EQ(replayed.rois.size(), stored.rois.size());
    ASSERT_EQ(replayed.detections.size(), stored.detections.size());
    for (std::size_t i = 0; i < stored.clusters.size(); ++i) {
        expectSame(replayed.clusters[i].box, stored.clusters[i].box);
        EXPECT_EQ(replayed.clusters[i].members, stored.clusters[i].members);
    }
    for (std::size_t i = 0; i < stored.rois.size(); ++i) expectSame(replayed.rois[i], stored.rois[i]);
    for (std::size_t i = 0; i < stored.detections.size(); ++i) {
        expectSame(replayed.detections[i].box, stored.detections[i].box);
        EXPECT_EQ(replayed.detections[i].score, stored.detections[i].score);
        EXPECT_EQ(replayed.detections[i].vectors, stored.detections[i].vectors);
        EXPECT_EQ(replayed.detections[i].rejection, stored.detections[i].rejection);
    }
}

}  // namespace

TEST(Replay, findsWhatTheRunFoundInAnyFrameAndOrder) {
    StoredRun run({});
    Replay replay(run.replaySource());
    for (const FrameIndex frame : {30, 31, 12, 39, 0}) {
        const ReplayedFrame* replayed = replay.at(frame, {});
        ASSERT_NE(replayed, nullptr);
        EXPECT_TRUE(replayed->exact);
        EXPECT_EQ(replayed->frame.index, frame);
        expectSame(replayed->result, run.stored(frame));
    }
    EXPECT_FALSE(run.stored(30).detections.empty());
    EXPECT_EQ(run.frames_read, 5);  // without stacks and differences nothing before a frame plays a part
}

TEST(Replay, startsEarlyEnoughForTheBackground) {
    ChainOptions options;
    options.difference.method = MotionMethod::median_background;
    options.difference.background_frames = 5;
    options.difference.background_step = 2;
    StoredRun run(options);
    Replay replay(run.replaySource());
    const ReplayedFrame* replayed = replay.at(35, {});
    ASSERT_NE(replayed, nullptr);
    EXPECT_TRUE(replayed->exact);
    EXPECT_LT(run.frames_read, 25);
    expectSame(replayed->result, run.stored(35));
    ASSERT_TRUE(replayed->differences);
    EXPECT_EQ(replayed->differences->difference.values.size(), cv::Size(320, 240));
    EXPECT_EQ(replayed->differences->difference.reference.size(), cv::Size(320, 240));
    EXPECT_GT(cv::countNonZero(replayed->differences->moving), 0);
}

TEST(Replay, buildsTheStacksAndSaysWhenTheyMayDiffer) {
    ChainOptions options;
    options.stacking.enabled = true;
    options.stacking.capacity = 10;
    options.stacking.min_height = 5;
    StoredRun run(options, 45);
    Replay replay(run.replaySource());
    const ReplayedFrame* early = replay.at(18, {});
    ASSERT_NE(early, nullptr);
    EXPECT_TRUE(early->exact);  // began with the run
    const std::vector<StackView> stacks = replay.stacks(StackPictures::surroundings);
    ASSERT_FALSE(stacks.empty());
    EXPECT_GT(stacks.front().height, 5);
    EXPECT_FALSE(stacks.front().stacked.empty());
    expectSame(early->result, run.stored(18));
    const ReplayedFrame* late = replay.at(44, {});
    ASSERT_NE(late, nullptr);
    EXPECT_FALSE(late->exact);
    EXPECT_FALSE(replay.stacks(StackPictures::none).empty());
}

TEST(Replay, tracesTheStepsOfOneCluster) {
    StoredRun run({});
    Replay replay(run.replaySource());
    EXPECT_TRUE(replay.trace(0).empty());
    const ReplayedFrame* replayed = replay.at(30, {});
    ASSERT_NE(replayed, nullptr);
    const auto traces = replay.trace(0);
    ASSERT_EQ(traces.size(), 1U);
    EXPECT_EQ(traces[0].trace.layers.front().kind, TraceLayer::raw);
    EXPECT_GT(traces[0].trace.layers.size(), 3U);
    for (const auto& layer : traces[0].trace.layers) EXPECT_EQ(layer.image.size(), traces[0].roi.image.size());
    EXPECT_TRUE(replay.trace(static_cast<int>(replayed->result.clusters.size())).empty());
    EXPECT_TRUE(replay.trace(-1).empty());
}

TEST(Replay, stopsBetweenFramesAndGoesOnFromThere) {
    ChainOptions options;
    options.stacking.enabled = true;
    StoredRun run(options);
    std::stop_source stop;
    ReplaySource source = run.replaySource();
    auto pixels = source.pixels;
    source.pixels = [&](FrameIndex frame) {
        if (frame == 9) stop.request_stop();
        return pixels(frame);
    };
    Replay replay(std::move(source));
    EXPECT_EQ(replay.at(20, stop.get_token()), nullptr);
    EXPECT_EQ(run.frames_read, 10);
    const ReplayedFrame* replayed = replay.at(20, {});
    ASSERT_NE(replayed, nullptr);
    EXPECT_EQ(run.frames_read, 21);  // none twice
    expectSame(replayed->result, run.stored(20));
}

TEST(Replay, hasNoFramesThatTheRunHasNot) {
    StoredRun run({}, 20);
    Replay replay(run.replaySource());
    EXPECT_EQ(replay.at(20, {}), nullptr);
    EXPECT_EQ(replay.at(-1, {}), nullptr);
    EXPECT_NE(replay.at(19, {}), nullptr);
}

TEST(Replay, namesStoredParametersThatItDoesNotKnow) {
    std::vector<std::string> unknown;
    const ChainOptions options =
        storedOptions({{"stacking.capacity", "33"}, {"no.such", "1"}, {"stacking.min_height", "many"}}, &unknown);
    EXPECT_EQ(options.stacking.capacity, 33);
    EXPECT_EQ(options.stacking.min_height, ChainOptions{}.stacking.min_height);
    EXPECT_EQ(unknown, (std::vector<std::string>{"no.such", "stacking.min_height"}));
}

}  // namespace eyrie::replay_test
