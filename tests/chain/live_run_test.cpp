#include "chain/live/live_run.h"

#include <gmock/gmock.h>

#include <fstream>
#include <opencv2/imgproc.hpp>

#include "chain/recording/run_recorder.h"
#include "core/error.h"
#include "core/time/utc_time.h"
#include "io/video/video_writer.h"
#include "support/live_sender.h"
#include "support/moving_scene.h"
#include "support/shared_data.h"
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
    /// The first of a folder of images as a transport stream.
    std::filesystem::path filmOf(const std::filesystem::path& pictures, int frames) {
        SourceOptions rate;
        rate.frame_rate_hz = 25;
        const auto source = openSource(pictures, rate);
        VideoWriterOptions options;
        options.key_frame_distance = 10;
        options.quality = 12;
        VideoWriter writer(folder_ / "film.ts", source->info().size, options);
        for (int i = 0; i < frames; ++i) writer.write(source->read(i, true).colour);
        writer.finish();
        return folder_ / "film.ts";
    }
    LiveRequest request(int waiting_frames) const {
        LiveRequest request;
        request.address = address();
        request.project = project_;
        request.gsd_m_per_px = 0.2;
        request.options.view.oblique = false;  // a look at the first frames would come before the run
        request.stream.stall_s = 1;
        request.stream.give_up_s = 2;
        request.stream.waiting_frames = waiting_frames;
        return request;
    }
    std::string address() const { return "udp://127.0.0.1:" + std::to_string(port_); }
    test::TemporaryFolder folder_;
    std::filesystem::path project_ = folder_ / "live.eyrie";
    int port_ = test::freePort();
};

/// Holds the first frame until the stream has left some out.
struct Slow : ChainObserver {
    explicit Slow(const LiveRun& of) : run(of) {}
    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
        if (result->motion.frame > 0) return;
        test::waitUntil("frames were left out", [&] {
            const LiveLoad load = run.status().load;
            return load.facts.skipped > load.left_out_for_scale;
        });
    }
    const LiveRun& run;
};

TEST_F(LiveRuns, ARunOverASourceIsOneOverItsRecording) {
    const test::LiveSender sender(port_, {{film(60), 2, 0.3}});
    LiveRun run(request(1000), {});
    const LiveRunResult result = run.run();
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
    LiveRun run(request(8), {});
    Slow slow(run);
    const LiveRunResult result = run.run(&slow);
    EXPECT_EQ(result.summary.outcome, RunOutcome::finished) << result.summary.message;
    EXPECT_GT(result.load.facts.skipped, 0);
    EXPECT_GT(result.load.fewer_corners, 0);
    EXPECT_THAT(result.record.message, testing::AllOf(testing::HasSubstr("left out, since the chain was behind"),
                                                      testing::HasSubstr("with fewer corners")));
    ProjectFile project = ProjectFile::open(project_);
    int frozen = 0, first = 0;
    const auto frames = RunStore(project).frameSummaries(result.record.id);
    for (const FrameSummary& frame : frames) {
        frozen += frame.state == RegistrationState::frozen ? 1 : 0;
        first += frame.state == RegistrationState::first ? 1 : 0;
    }
    EXPECT_EQ(first, 1) << "a lighter chain goes on from the picture before";
    EXPECT_EQ(static_cast<int>(frames.size()), result.load.facts.frames) << "every frame has its row";
    EXPECT_EQ(frozen, result.load.facts.skipped);
    EXPECT_EQ(result.record.last_frame, result.load.facts.frames - 1);
}

TEST_F(LiveRuns, AnUnknownScaleIsEstimatedFromTheFirstPicturesWhichTheRunHasAllTheSame) {
    EYRIE_NEED_SHARED_DATA("collage_day");
    const test::LiveSender sender(port_, {{filmOf(test::sharedData("collage_day/frames"), 70), 3, 0.3}});
    LiveRequest wanted = request(1000);
    wanted.gsd_m_per_px = 0;
    LiveRun run(wanted, {});
    struct Looking : ChainObserver {
        void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
            frames.push_back(result->motion.frame);
        }
        void onProgress(const RunProgress& progress) override {
            if (progress.estimating_scale) looked += frames.empty() ? 1 : -1000;
        }
        int looked = 0;
        std::vector<FrameIndex> frames;
    } looking;
    ScaleBasis told;
    const LiveRunResult result = run.run(&looking, [&](const RunRecord& record) { told = record.scale_basis; });
    EXPECT_EQ(result.summary.outcome, RunOutcome::finished) << result.summary.message;
    EXPECT_GT(looking.looked, 0) << "before the first frame of the run";
    EXPECT_EQ(result.record.scale_basis.origin, ScaleOrigin::estimated);
    EXPECT_EQ(told, result.record.scale_basis);
    EXPECT_NEAR(result.record.scale.gsd_m_per_px, 0.2, 0.04);
    EXPECT_FALSE(result.record.scale.gsd_known) << "a guess is no knowledge";
    ASSERT_GT(looking.frames.size(), 40u);
    for (std::size_t i = 0; i < looking.frames.size(); ++i) ASSERT_EQ(looking.frames[i], static_cast<FrameIndex>(i));
}

TEST_F(LiveRuns, WhatTheMetadataSayOfTheScaleIsTaken) {
    EYRIE_NEED_SHARED_DATA("klv");
    const test::LiveSender sender(port_, {{test::sharedData("klv/aphill_short.ts"), 4, 0.3}});
    LiveRequest wanted = request(1000);
    wanted.gsd_m_per_px = 0;
    const LiveRunResult result = LiveRun(wanted, {}).run();
    EXPECT_EQ(result.summary.outcome, RunOutcome::finished) << result.summary.message;
    EXPECT_EQ(result.record.scale_basis.origin, ScaleOrigin::metadata);
    EXPECT_TRUE(result.record.scale.gsd_known);
    EXPECT_NEAR(result.record.scale.gsd_m_per_px, 0.0456, 0.001);
    EXPECT_TRUE(std::filesystem::exists(project_));
}

TEST_F(LiveRuns, WhatWasLeftOutWhileTheScaleWasLookedForIsToldApart) {
    LiveLoad load;
    load.facts.frames = 900;
    load.facts.skipped = 120;
    load.left_out_for_scale = 100;
    EXPECT_EQ(
        load.text(),
        "100 of 900 frames left out while the scale was looked for; 20 of 900 frames left out, since the chain was "
        "behind");
    load.facts.skipped = 100;
    EXPECT_EQ(load.text(), "100 of 900 frames left out while the scale was looked for");
}

TEST(LiveWords, EverythingThatWasGivenUpIsTold) {
    LiveLoad load;
    load.facts.frames = 900;
    EXPECT_EQ(load.text(), "");
    load.facts.skipped = 1;
    EXPECT_EQ(load.text(), "1 of 900 frames left out, since the chain was behind");
    load.fewer_corners = 1;
    load.facts.reconnects = 1;
    load.facts.longest_gap_s = 3.26;
    load.facts.ended = "no space";
    EXPECT_EQ(
        load.text(),
        "1 of 900 frames left out, since the chain was behind; 1 of 900 frames with fewer corners; connected again "
        "1×, longest gap 3.3 s; ended: no space");
    load.left_out_for_scale = 1;
    load.fewer_corners = 0;
    load.facts.reconnects = 0;
    load.facts.ended.clear();
    EXPECT_EQ(load.text(), "1 of 900 frames left out while the scale was looked for");
}

TEST_F(LiveRuns, AtAnyMomentItSaysHowItStands) {
    const test::LiveSender sender(port_, {{film(60), 3, 0.3}});
    ProjectFile::openOrCreate(project_);  // others may be in it
    LiveRun run(request(1000), {});
    struct Asked : ChainObserver {
        explicit Asked(const LiveRun& of) : run(of) {}
        void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
            const LiveStatus status = run.status();
            EXPECT_GT(status.load.facts.frames, result->motion.frame);
            EXPECT_GE(status.behind_s, 0);
            EXPECT_LT(status.behind_s, 5);
            EXPECT_FALSE(status.lighter);
        }
        const LiveRun& run;
    } asked(run);
    int begun = 0;
    const LiveRunResult result = run.run(&asked, [&](const RunRecord& record) { begun = record.id; });
    EXPECT_EQ(begun, result.record.id);
    EXPECT_EQ(result.record.name, address()) << "unless another name is given";
    EXPECT_EQ(run.status().behind_s, 0);
    EXPECT_EQ(run.recording(), folder_ / "live.ts");
}

TEST_F(LiveRuns, NothingIsLeftOfASourceThatDoesNotAnswer) {
    LiveRequest wanted = request(10);
    wanted.stream.connect_s = 0.5;
    EXPECT_THROW(LiveRun(wanted, {}), Error);
    EXPECT_FALSE(std::filesystem::exists(project_));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "live.ts"));
}

TEST_F(LiveRuns, NoProjectIsLeftOfARunThatDidNotBegin) {
    const test::LiveSender sender(port_, {{film(30), 2, 0.3}});
    {
        LiveRun run(request(1000), {});
        EXPECT_THROW(run.run(nullptr, [](const RunRecord&) { throw Error(ErrorKind::internal, "no"); }), Error);
        EXPECT_TRUE(std::filesystem::exists(project_));
    }
    EXPECT_FALSE(std::filesystem::exists(project_));
}

TEST_F(LiveRuns, WhatMayNotBeWrittenIsToldBeforeItWaitsForTheSource) {
    LiveRequest wanted = request(10);
    wanted.stream.recording = film(10);
    try {
        const LiveRun run(wanted, {});
        FAIL() << "the film would be lost";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::output);
        EXPECT_THAT(error.what(), testing::HasSubstr("exists already"));
    }
    wanted.stream.recording = folder_ / "absent/live.ts";
    EXPECT_THROW(LiveRun(wanted, {}), Error);
}

TEST(LivePlaces, AreNamedAfterTheTimeAndTheProject) {
    const std::string before = nowUtc(), name = timedProjectName().string(), after = nowUtc();
    const auto named = [](const std::string& utc) {  // 2026-11-21T08:00:00Z
        return "live-" + utc.substr(0, 4) + utc.substr(5, 2) + utc.substr(8, 2) + "-" + utc.substr(11, 2) +
               utc.substr(14, 2) + utc.substr(17, 2) + ".eyrie";
    };
    EXPECT_GE(name, named(before));
    EXPECT_LE(name, named(after));
    const test::TemporaryFolder folder;
    EXPECT_EQ(recordingFor(folder / "a.eyrie"), folder / "a.ts");
    std::ofstream(folder / "a.ts") << "earlier";
    EXPECT_EQ(recordingFor(folder / "a.eyrie"), folder / "a-2.ts");
    std::ofstream(folder / "a-2.ts") << "earlier";
    EXPECT_EQ(recordingFor(folder / "a.eyrie"), folder / "a-3.ts");
    EXPECT_TRUE(recordingFor("a.eyrie").is_absolute());
    EXPECT_EQ(remarkOnRecording(10, 10), "");
    EXPECT_THAT(remarkOnRecording(9, 10), testing::HasSubstr("shows 9 frames, the run has 10"));
}

TEST_F(LiveRuns, FewerCornersAreLessThanHalf) {
    const ChainOptions all;
    const double spacing = withFewerCorners(all).registration.corners.corner_spacing_m;
    EXPECT_NEAR(spacing, 1.5 * all.registration.corners.corner_spacing_m, 1e-9);
}

}  // namespace
}  // namespace eyrie::live_run_test
