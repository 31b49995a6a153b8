#include "rerun/range_run.h"

#include <gtest/gtest.h>

#include "chain/chain.h"
#include "chain/recording/classified_vehicles.h"
#include "chain/recording/run_recorder.h"
#include "support/moving_scene.h"

namespace eyrie::range_run_test {
namespace {

/// A run over a small scene, kept in memory.
class RangeRun : public testing::Test {
 protected:
    void SetUp() override {
        scale_ = sceneScale(source_.info(), 0.2);
        static const std::vector<FrameResult> made_once = runWith({});
        stored_ = made_once;
    }

    /// What a whole run finds, its tracks finished.
    std::vector<FrameResult> runWith(const ChainOptions& options) {
        Chain chain(options, scale_);
        std::vector<FrameResult> results;
        std::vector<TimedState> states;
        std::vector<FrameMotionSummary> motions;
        VectorsByFrame vectors;
        ClassifiedByFrame classified;
        for (FrameIndex f = 0; f < scene_.frames; ++f) {
            results.push_back(chain.next(source_.read(f, false)));
            for (const TrackState& state : results.back().tracks) states.emplace_back(f, state);
            const FrameMotion& motion = results.back().motion;
            motions.push_back({f, motion.registration, motion.image_size});
            vectors[f] = motion.motion_vectors;
            classified[f] = classifiedOf(results.back().detections);
            results.back().tracks.clear();
        }
        for (const auto& [frame, state] :
             finishTracks(states, motions, options.finishing, scale_,
                          {vectorsIn(vectors), classifiedVehicles(options, classifiedIn(classified))}))
            results[static_cast<std::size_t>(frame)].tracks.push_back(state);
        return results;
    }
    ReplaySource replaySource() {
        ReplaySource replay;
        replay.scale = scale_;
        replay.pixels = [this](FrameIndex frame) {
            ++frames_read_;
            return source_.read(frame, false);
        };
        replay.result_of = [this](FrameIndex frame) -> std::optional<FrameResult> {
            if (frame < 0 || frame >= static_cast<int>(stored_.size())) return std::nullopt;
            return stored_[static_cast<std::size_t>(frame)];
        };
        return replay;
    }
    void expectSame(const ChainOptions& options) {
        const auto whole = runWith(options);
        const auto again = runRange(replaySource(), options, {0, scene_.frames - 1}, {});
        ASSERT_TRUE(again);
        EXPECT_TRUE(again->exact);
        ASSERT_EQ(again->frames.size(), whole.size());
        int tracks = 0;
        for (const auto& [frame, found] : again->frames) {
            const FrameResult& expected = whole[static_cast<std::size_t>(frame)];
            ASSERT_EQ(found->detections.size(), expected.detections.size()) << "frame " << frame;
            ASSERT_EQ(found->tracks.size(), expected.tracks.size()) << "frame " << frame;
            for (std::size_t i = 0; i < expected.tracks.size(); ++i) {
                EXPECT_EQ(found->tracks[i].id, expected.tracks[i].id);
                EXPECT_EQ(found->tracks[i].box.centre, expected.tracks[i].box.centre);
                ++tracks;
            }
        }
        EXPECT_GT(tracks, 10);
    }

    test::MovingScene scene_;
    test::MemorySource source_{scene_};
    SceneScale scale_;
    std::vector<FrameResult> stored_;
    int frames_read_ = 0;
};

TEST_F(RangeRun, FindsWhatAWholeRunFinds) {
    ChainOptions clustering;
    clustering.clustering.min_members = 4;
    expectSame(clustering);
    ChainOptions motion;
    motion.motion.min_speed_m_s *= 1.3;
    expectSame(motion);
    ChainOptions stacking;
    stacking.stacking.enabled = true;
    expectSame(stacking);
    frames_read_ = 0;
    ChainOptions tracking;
    tracking.tracking.min_overlap = 0.3;
    expectSame(tracking);
    EXPECT_EQ(frames_read_, 0);  // detections are those of the run
}

TEST_F(RangeRun, APartLeadsUpToItsFirstFrameAndTellsHowFarItIs) {
    ChainOptions options;
    options.clustering.min_members = 4;
    const FrameIndex last = scene_.frames - 1;
    int told = 0;
    std::vector<FrameIndex> frames;
    const auto part = runRange(replaySource(), options, {last - 3, last + 50}, {},
                               [&](const std::shared_ptr<const FrameResult>& result, int done, int total) {
                                   EXPECT_EQ(done, ++told);
                                   EXPECT_GE(total, done);
                                   if (result) frames.push_back(result->motion.frame);
                               });
    ASSERT_TRUE(part);
    EXPECT_EQ(part->start, ChainStage::clustering);
    EXPECT_EQ(frames, (std::vector<FrameIndex>{last - 3, last - 2, last - 1, last}));
    EXPECT_EQ(part->frames.size(), 4U);
    EXPECT_GT(told, 4);
    EXPECT_EQ(trackBoxesOf(*part).size(), 4U);
    EXPECT_EQ(detectionBoxesOf(*part).begin()->second.front().id, std::nullopt);
}

TEST_F(RangeRun, StopsWhenAsked) {
    std::stop_source stop;
    const auto nothing = runRange(replaySource(), {}, {0, 10}, stop.get_token(),
                                  [&](const std::shared_ptr<const FrameResult>&, int done, int) {
                                      if (done == 3) stop.request_stop();
                                  });
    EXPECT_FALSE(nothing);
    const auto beyond = runRange(replaySource(), {}, {5000, 5010}, {});
    ASSERT_TRUE(beyond);
    EXPECT_TRUE(beyond->frames.empty());
}

}  // namespace
}  // namespace eyrie::range_run_test
