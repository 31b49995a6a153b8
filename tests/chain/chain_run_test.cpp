#include "chain/chain_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

#include "chain/chain.h"
#include "core/error.h"
#include "support/moving_scene.h"

namespace eyrie::chain_run_test {
namespace {

class Collector : public ChainObserver {
 public:
    std::vector<std::shared_ptr<const FrameResult>> results;
    std::stop_source* stop_after_ten = nullptr;
    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame& frame) override {
        EXPECT_EQ(result->motion.frame, frame.index);
        results.push_back(result);
        if (stop_after_ten && results.size() == 10) stop_after_ten->request_stop();
    }
};

SceneScale scale() {
    SceneScale s;
    s.gsd_m_per_px = 0.2;
    s.gsd_known = true;
    return s;
}

bool isFollowed(const FrameResult& result, cv::Point2d centre) {
    for (const auto& track : result.tracks) {
        if (track.status != TrackStatus::tentative && cv::norm(track.box.centre - centre) < 5) return true;
    }
    return false;
}

}  // namespace

TEST(ChainRun, followsEveryVehicleUnderAPanningCamera) {
    const test::MovingScene scene;
    test::MemorySource source(scene);
    Collector collector;
    const RunSummary summary = ChainRun(ChainOptions{}, scale()).run(source, {}, collector, {});
    ASSERT_EQ(summary.outcome, RunOutcome::finished) << summary.message;
    EXPECT_EQ(summary.frames_done, scene.frames);
    EXPECT_EQ(summary.unregistered_frames, 0);
    int followed = 0;
    int wanted = 0;
    for (int frame = 20; frame < scene.frames; ++frame) {
        for (const auto& vehicle : scene.vehicles) {
            ++wanted;
            followed += isFollowed(*collector.results[std::size_t(frame)], scene.vehicleAt(vehicle, frame));
        }
    }
    EXPECT_GE(followed, wanted * 9 / 10);
    for (std::size_t stage = 0; stage < summary.median_ms.size(); ++stage) {
        std::vector<float> times;
        for (const auto& result : collector.results) times.push_back(result->stage_ms[stage]);
        std::sort(times.begin(), times.end());
        EXPECT_EQ(summary.median_ms[stage], times[times.size() / 2]) << stage;
    }
}

TEST(ChainRun, tellsHowManyFramesAreDoneAndHowLongTheOthersTake) {
    test::MovingScene scene;
    scene.frames = 12;
    test::MemorySource source(scene);
    struct : ChainObserver {
        void onFrame(const std::shared_ptr<const FrameResult>&, const Frame&) override {}
        void onProgress(const RunProgress& progress) override { told.push_back(progress); }
        std::vector<RunProgress> told;
    } observer;
    ChainRun(ChainOptions{}, scale()).run(source, {}, observer, {});
    ASSERT_EQ(observer.told.size(), 12U);
    for (int i = 0; i < 12; ++i) {
        const RunProgress& at = observer.told[std::size_t(i)];
        EXPECT_EQ(at.frames_done, i + 1);
        EXPECT_EQ(at.frames_total, 12);
        EXPECT_EQ(at.frames_per_second > 0, i > 0) << "two frames tell a speed";
        EXPECT_NEAR(at.seconds_left * at.frames_per_second, i > 0 ? 11 - i : 0, 1e-6);
    }
}

// Tracks are scored by it: without it false alarms stay.
TEST(ChainRun, theClassifierIsAskedAboutBoxesInAnObliqueViewToo) {
    test::MovingScene scene;
    scene.frames = 14;
    for (const double down : {0.0, 0.0005}) {
        test::MemorySource source(scene);
        Collector collector;
        SceneScale tilted = scale();
        tilted.slope = ScaleSlope::ofPicture(scene.size, 0, down);
        ASSERT_EQ(ChainRun(ChainOptions{}, tilted).run(source, {}, collector, {}).outcome, RunOutcome::finished);
        int asked = 0;
        for (const auto& result : collector.results)
            for (const Detection& detection : result->detections) asked += std::isfinite(detection.decision);
        EXPECT_GT(asked, 0) << down;
    }
}

TEST(ChainRun, runningTheHalvesSideBySideChangesNothing) {
    const test::MovingScene scene;
    test::MemorySource source(scene);
    Collector collector;
    ChainRun(ChainOptions{}, scale()).run(source, {}, collector, {});
    Chain chain(ChainOptions{}, scale());
    for (int frame = 0; frame < scene.frames; ++frame) {
        const FrameResult alone = chain.next(source.read(frame, false));
        const FrameResult& beside = *collector.results.at(std::size_t(frame));
        ASSERT_EQ(alone.motion.registration.current_from_previous.matrix,
                  beside.motion.registration.current_from_previous.matrix);
        ASSERT_EQ(alone.tracks.size(), beside.tracks.size()) << "frame " << frame;
        for (std::size_t i = 0; i < alone.tracks.size(); ++i) {
            EXPECT_EQ(alone.tracks[i].box.centre, beside.tracks[i].box.centre);
        }
    }
}

TEST(ChainRun, clusteringCanBeLookedAtOnceMoreWhereItTookPlace) {
    test::MovingScene scene;
    scene.frames = 12;
    for (const bool differences : {false, true}) {
        ChainOptions options;
        if (differences) options.difference.method = MotionMethod::two_frame_difference;
        test::MemorySource source(scene);
        MotionHalf motion_half(options, scale());
        TrackHalf track_half(options, scale());
        FrameResult result;
        for (int frame = 0; frame < scene.frames; ++frame) {
            const Frame read = source.read(frame, false);
            StageTimes times{};
            result = track_half.next(read, motion_half.next(read, times), times);
        }
        ASSERT_FALSE(result.clusters.empty());
        const ClusteringTrace trace = track_half.clustering(result.motion);
        EXPECT_EQ(trace.groups.empty(), differences);
        EXPECT_EQ(track_half.differences() != nullptr, differences);
    }
}

TEST(ChainRun, stopsWhenAskedAndKeepsWhatIsDone) {
    const test::MovingScene scene;
    test::MemorySource source(scene);
    Collector collector;
    std::stop_source stop;
    collector.stop_after_ten = &stop;
    const RunSummary summary = ChainRun(ChainOptions{}, scale()).run(source, {}, collector, stop.get_token());
    EXPECT_EQ(summary.outcome, RunOutcome::stopped);
    EXPECT_EQ(summary.frames_done, 10);
}

TEST(ChainRun, anUnreadableFrameEndsTheRunAsFailedAfterTheFramesBefore) {
    const test::MovingScene scene;
    test::MemorySource source(scene.frames, scene.size, [&](int index) {
        if (index == 12) throw Error(ErrorKind::input, "frame 12 is broken");
        return scene.draw(index);
    });
    Collector collector;
    const RunSummary summary = ChainRun(ChainOptions{}, scale()).run(source, {}, collector, {});
    EXPECT_EQ(summary.outcome, RunOutcome::failed);
    EXPECT_EQ(summary.message, "frame 12 is broken");
    EXPECT_EQ(collector.results.size(), 12U);
}

TEST(ChainRun, anObserverThatFailsEndsTheRun) {
    class FullDisk : public ChainObserver {
        void onFrame(const std::shared_ptr<const FrameResult>&, const Frame&) override {
            throw Error(ErrorKind::output, "no space left");
        }
    } observer;
    const test::MovingScene scene;
    test::MemorySource source(scene);
    const RunSummary summary = ChainRun(ChainOptions{}, scale()).run(source, {}, observer, {});
    EXPECT_EQ(summary.outcome, RunOutcome::failed);
    EXPECT_EQ(summary.message, "no space left");
}

TEST(ChainRun, whateverGoesWrongEndsTheRunAndSaysWhoHasToAct) {
    test::MovingScene scene;
    scene.frames = 6;
    scene.size = {96, 72};
    const auto runOver = [&](const std::function<void(int)>& trouble) {
        test::MemorySource source(6, scene.size, [&](int index) {
            if (index == 4) trouble(index);
            return scene.draw(index);
        });
        Collector collector;
        RunSummary summary = ChainRun(ChainOptions{}, scale()).run(source, {}, collector, {});
        EXPECT_EQ(collector.results.size(), summary.outcome == RunOutcome::failed ? 4U : 6U);
        EXPECT_EQ(summary.frames_done, static_cast<int>(collector.results.size()));
        EXPECT_EQ(summary.frames_total, 6);
        return summary;
    };
    EXPECT_EQ(runOver([](int) {}).outcome, RunOutcome::finished);
    const RunSummary disk = runOver([](int) { throw Error(ErrorKind::output, "no space"); });
    EXPECT_EQ(disk.error, ErrorKind::output);
    EXPECT_EQ(disk.message, "no space");
    const RunSummary memory = runOver([](int) { throw std::bad_alloc(); });
    EXPECT_EQ(memory.error, ErrorKind::input);
    EXPECT_EQ(memory.message, "memory: not enough memory; close other programs or use fewer frames");
    const RunSummary other = runOver([](int) { throw std::runtime_error("out of order"); });
    EXPECT_EQ(other.error, ErrorKind::internal);
    EXPECT_EQ(other.message, "out of order");
}

TEST(ChainRun, refusesARangeOutsideTheVideo) {
    const test::MovingScene scene;
    test::MemorySource source(scene);
    Collector collector;
    for (const FrameRange range : {FrameRange{-1, 5}, FrameRange{0, 1000}, FrameRange{30, 20}, FrameRange{1000, -1}}) {
        const RunSummary summary = ChainRun(ChainOptions{}, scale()).run(source, range, collector, {});
        EXPECT_EQ(summary.outcome, RunOutcome::failed);
        EXPECT_THAT(summary.message, testing::HasSubstr("frames 0 to 39"));
    }
    const RunSummary part = ChainRun(ChainOptions{}, scale()).run(source, {5, 14}, collector, {});
    EXPECT_EQ(part.frames_done, 10);
    EXPECT_EQ(collector.results.front()->motion.frame, 5);
}

}  // namespace eyrie::chain_run_test
