#include "chain/live/live_run.h"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "chain/recording/run_recorder.h"
#include "io/video/video_writer.h"
#include "support/live_sender.h"
#include "support/moving_scene.h"
#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace eyrie::live_run_test {
namespace {

class LiveRuns : public testing::Test {
 protected:
    std::filesystem::path film(int frames) {
        test::MovingScene scene;
        scene.frames = frames;
        VideoWriterOptions options;
        options.key_frame_distance = 10;
        options.quality = 12;
        VideoWriter writer(folder_ / "film.ts", scene.size, options);
        for (int i = 0; i < frames; ++i) {
            cv::Mat colour;
            cv::cvtColor(scene.draw(i), colour, cv::COLOR_GRAY2BGR);
            writer.write(colour);
        }
        writer.finish();
        return folder_ / "film.ts";
    }
    LiveOptions options() const {
        LiveOptions options;
        options.recording = folder_ / "live.ts";
        options.stall_s = 1;
        options.give_up_s = 2;
        return options;
    }
    LiveRunResult live(LiveStream& stream, ChainObserver* also = nullptr) {
        const SceneScale scale = sceneScale(stream.info(), 0.2);
        const ChainOptions chain;
        return runLive(stream, project_, plannedRun(stream.info(), scale, {}, "default"), chain, also);
    }
    std::string address() const { return "udp://127.0.0.1:" + std::to_string(port_); }
    test::TemporaryFolder folder_;
    std::filesystem::path project_ = folder_ / "live.eyrie";
    int port_ = test::freePort();
};

/// Holds the first frame until the stream has left some out.
struct Slow : ChainObserver {
    explicit Slow(const LiveStream& from) : stream(from) {}
    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
        if (result->motion.frame > 0) return;
        test::waitUntil("frames were left out", [&] { return stream.facts().skipped > 0; });
    }
    const LiveStream& stream;
};

TEST_F(LiveRuns, ARunOverASourceIsOneOverItsRecording) {
    const test::LiveSender sender(port_, {{film(60), 6, 0.3}});
    LiveOptions roomy = options();
    roomy.waiting_frames = 1000;
    LiveStream stream(address(), roomy, {});
    const LiveRunResult result = live(stream);
    EXPECT_EQ(result.summary.outcome, RunOutcome::finished) << result.summary.message;
    EXPECT_EQ(result.record.state, RunState::finished);
    EXPECT_GE(result.record.frames_done, 50);
    EXPECT_EQ(result.record.last_frame, result.record.frames_done - 1);
    EXPECT_EQ(result.record.sequence.frame_count, result.record.frames_done);
    EXPECT_EQ(result.load.facts.skipped, 0);
    const auto recording = openSource(result.record.sequence.path, {.index_folder = folder_ / "index"});
    EXPECT_EQ(recording->info().frame_count, result.record.frames_done);
    ProjectFile project = ProjectFile::open(project_);
    EXPECT_FALSE(RunStore(project).trackBoxes(result.record.id).empty());
    // The tracks are those that a run over the recording finds.
    const SceneScale scale = sceneScale(recording->info(), 0.2);
    RunRecorder again(project_, plannedRun(recording->info(), scale, {}, "default"), ChainOptions{});
    again.finish(ChainRun(ChainOptions{}, scale).run(*recording, {}, again, {}));
    const auto boxes = RunStore(project).trackBoxes(result.record.id);
    const auto later = RunStore(project).trackBoxes(again.runId());
    ASSERT_EQ(boxes.size(), later.size());
    for (const auto& [frame, records] : boxes) {
        ASSERT_EQ(records.size(), later.at(frame).size()) << frame;
        for (std::size_t i = 0; i < records.size(); ++i)
            EXPECT_EQ(records[i].box.centre, later.at(frame)[i].box.centre) << frame;
    }
}

TEST_F(LiveRuns, AChainThatIsBehindTakesFewerCornersAndLeavesFramesOutAndSaysSo) {
    const test::LiveSender sender(port_, {{film(80), 1, 0.3}});
    LiveOptions narrow = options();
    narrow.waiting_frames = 8;
    LiveStream stream(address(), narrow, {});
    Slow slow(stream);
    const LiveRunResult result = live(stream, &slow);
    EXPECT_EQ(result.summary.outcome, RunOutcome::finished) << result.summary.message;
    EXPECT_GT(result.load.facts.skipped, 0);
    EXPECT_GT(result.load.fewer_corners, 0);
    EXPECT_THAT(result.record.message, testing::AllOf(testing::HasSubstr("left out, since the chain was behind"),
                                                      testing::HasSubstr("with fewer corners")));
    ProjectFile project = ProjectFile::open(project_);
    int frozen = 0;
    const auto frames = RunStore(project).frameSummaries(result.record.id);
    for (const FrameSummary& frame : frames) frozen += frame.state == RegistrationState::frozen ? 1 : 0;
    EXPECT_EQ(static_cast<int>(frames.size()), result.load.facts.frames) << "every frame has its row";
    EXPECT_EQ(frozen, result.load.facts.skipped);
    EXPECT_EQ(result.record.last_frame, result.load.facts.frames - 1);
}

TEST_F(LiveRuns, FewerCornersAreLessThanHalf) {
    const ChainOptions all;
    const double spacing = withFewerCorners(all).registration.corners.corner_spacing_m;
    EXPECT_GT(spacing * spacing,
              2 * all.registration.corners.corner_spacing_m * all.registration.corners.corner_spacing_m);
}

}  // namespace
}  // namespace eyrie::live_run_test
