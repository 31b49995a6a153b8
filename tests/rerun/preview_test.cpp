#include "rerun/preview.h"

#include <gtest/gtest.h>

#include "chain/chain.h"
#include "chain/recording/run_recorder.h"
#include "core/error.h"
#include "support/moving_scene.h"

namespace eyrie::preview_test {
namespace {

/// A run over a small scene, kept in memory, and what a run with other parameters finds.
class Fixture {
 public:
    Fixture() : source_(scene_), scale_(sceneScale(source_.info(), 0.2)), stored_(storedRun(*this)) {}

    std::vector<FrameResult> runWith(const ChainOptions& options) {
        Chain chain(options, scale_);
        std::vector<FrameResult> results;
        for (FrameIndex f = 0; f < scene_.frames; ++f) results.push_back(chain.next(source_.read(f, false)));
        return results;
    }
    ReplaySource replaySource() {
        ReplaySource replay;
        replay.scale = scale_;
        replay.pixels = [this](FrameIndex frame) {
            ++frames_read;
            return source_.read(frame, false);
        };
        replay.result_of = [this](FrameIndex frame) -> std::optional<FrameResult> {
            if (frame < 0 || frame >= static_cast<int>(stored_.size())) return std::nullopt;
            return stored_[static_cast<std::size_t>(frame)];
        };
        return replay;
    }
    const FrameResult& stored(FrameIndex frame) const { return stored_[static_cast<std::size_t>(frame)]; }
    int frames_read = 0;

 private:
    /// Made once for all tests.
    static const std::vector<FrameResult>& storedRun(Fixture& any) {
        static const std::vector<FrameResult> results = any.runWith({});
        return results;
    }
    test::MovingScene scene_;
    test::MemorySource source_;
    SceneScale scale_;
    const std::vector<FrameResult>& stored_;
};

void expectSame(const FrameResult& a, const FrameResult& b) {
    ASSERT_EQ(a.clusters.size(), b.clusters.size());
    for (std::size_t i = 0; i < a.clusters.size(); ++i) EXPECT_EQ(a.clusters[i].members, b.clusters[i].members);
    ASSERT_EQ(a.detections.size(), b.detections.size());
    for (std::size_t i = 0; i < a.detections.size(); ++i) {
        EXPECT_EQ(a.detections[i].box.centre, b.detections[i].box.centre);
        EXPECT_EQ(a.detections[i].rejection, b.detections[i].rejection);
        EXPECT_EQ(a.detections[i].vectors, b.detections[i].vectors);
    }
}

void expectSameBoxes(const std::vector<TrackState>& a, const std::vector<TrackState>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (const TrackState& state : a)
        EXPECT_TRUE(std::any_of(b.begin(), b.end(), [&](const TrackState& other) {
            return other.box.centre == state.box.centre && other.status == state.status;
        }));
}

TEST(Preview, isWhatARunWithTheseParametersFinds) {
    Fixture run;
    const auto with = [](auto change) {
        ChainOptions options;
        change(options);
        return options;
    };
    for (const ChainOptions& options : {with([](ChainOptions& o) { o.tracking.confirm_hits = 2; }),
                                        with([](ChainOptions& o) { o.outliers.min_vectors = 9; }),
                                        with([](ChainOptions& o) { o.detection.method = DetectionMethod::gradient; }),
                                        with([](ChainOptions& o) { o.clustering.min_members = 12; }),
                                        with([](ChainOptions& o) { o.motion.min_speed_m_s = 9; }),
                                        with([](ChainOptions& o) { o.registration.corners.corner_spacing_m = 1; })}) {
        Preview preview(run.replaySource());
        const auto expected = run.runWith(options);
        const auto now = preview.now(30, options, 30, {});
        ASSERT_TRUE(now);
        // The first answer on other motion vectors comes from a short window; the second reaches back to frame 0.
        if (!now->approximate) expectSame(now->result, expected[30]);
        const auto whole = preview.withTracks(30, options, 30, {}, {});
        ASSERT_TRUE(whole);
        expectSame(whole->result, expected[30]);
        const auto again = preview.now(30, options, 30, {});
        ASSERT_TRUE(again);
        expectSame(again->result, expected[30]);
        EXPECT_TRUE(whole->tracks_final);
        // The range reaches back to the first frame, so the tracks are those of a run, too; but only what lies behind
        // the motion vectors is done anew from the first frame on.
        if (whole->start >= ChainStage::clustering) expectSameBoxes(whole->result.tracks, expected[30].tracks);
    }
}

TEST(Preview, doesOnlyWhatChanged) {
    Fixture run;
    Preview preview(run.replaySource());
    ChainOptions options;
    options.outliers.min_vectors = 4;
    ASSERT_TRUE(preview.now(30, options, 20, {}));
    EXPECT_EQ(run.frames_read, 1);
    options.outliers.min_vectors = 5;
    options.clustering.min_members = 5;
    ASSERT_TRUE(preview.now(30, options, 20, {}));
    EXPECT_EQ(run.frames_read, 1);
    const auto back = preview.now(30, ChainOptions(), 20, {});
    EXPECT_EQ(back->start, ChainStage::none);
    expectSame(back->result, run.stored(30));
    options.motion.min_speed_m_s = 3;
    ASSERT_TRUE(preview.now(30, options, 0, {}));
    const int after_window = run.frames_read;
    for (double speed = 4; speed < 8; ++speed) {
        options.motion.min_speed_m_s = speed;
        ASSERT_TRUE(preview.now(30, options, 0, {}));
    }
    EXPECT_EQ(run.frames_read, after_window);
    EXPECT_TRUE(preview.now(30, options, 0, {})->approximate);
    options.motion.min_speed_m_s = ChainOptions().motion.min_speed_m_s;
    EXPECT_FALSE(preview.now(30, options, 0, {})->approximate);
}

TEST(Preview, warmedUpItReadsNothingMoreForParametersOfMotion) {
    Fixture run;
    Preview preview(run.replaySource());
    preview.warmUp(30, {});
    const int warm = run.frames_read;
    EXPECT_GT(warm, 10);
    ChainOptions options;
    options.motion.min_speed_m_s = 3;
    ASSERT_TRUE(preview.now(30, options, 30, {}));
    EXPECT_LE(run.frames_read, warm + 1);  // the pixels that are searched
    Preview cold(run.replaySource());
    const auto expected = cold.now(30, options, 30, {});
    expectSame(preview.now(30, options, 30, {})->result, expected->result);
    preview.warmUp(-5, {});
}

TEST(Preview, tracksKeepTheIdsOfTheRun) {
    Fixture run;
    Preview preview(run.replaySource());
    ChainOptions options;
    options.tracking.acceleration_m_s2 = 5;
    const auto now = preview.now(35, options, 30, {});
    for (const TrackState& track : now->result.tracks) {
        for (const TrackState& stored : run.stored(35).tracks) {
            if (overlap(track.box, stored.box) > 0.6) {
                EXPECT_EQ(track.id, stored.id);
            }
        }
    }
}

TEST(Preview, stacksAndDifferencesReachBack) {
    Fixture run;
    ChainOptions options;
    options.difference.method = MotionMethod::two_frame_difference;
    Preview preview(run.replaySource());
    const auto now = preview.now(30, options, 10, {});
    ASSERT_TRUE(now);
    EXPECT_EQ(now->start, ChainStage::clustering);
    EXPECT_FALSE(now->result.clusters.empty());
}

TEST(Preview, stopsAndRefusesWhatTheRunHasNot) {
    Fixture run;
    Preview preview(run.replaySource());
    std::stop_source stop;
    stop.request_stop();
    EXPECT_FALSE(preview.now(30, {}, 10, stop.get_token()));
    EXPECT_THROW(preview.now(999, {}, 10, {}), Error);
    ChainOptions options;
    options.detection.sliding_window.model = "no such model";
    EXPECT_THROW(preview.now(30, options, 0, {}), Error);
    EXPECT_TRUE(preview.now(30, {}, 0, {}));
}

}  // namespace
}  // namespace eyrie::preview_test
