#include "chain/recording/run_facts.h"

#include <gtest/gtest.h>

#include "chain/recording/run_recorder.h"
#include "support/moving_scene.h"
#include "support/temporary_folder.h"

namespace eyrie::run_facts_test {
namespace {

/// Pictures without anything on them.
class BlankSource : public FrameSource {
 public:
    BlankSource() {
        info_.path = "/nowhere/blank.mp4";
        info_.size = {160, 120};
        info_.frame_count = 12;
    }
    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool) override {
        Frame frame;
        frame.index = index;
        frame.time_us = timeOf(index);
        frame.gray = cv::Mat(info_.size, CV_8U, cv::Scalar(index));
        return frame;
    }
    std::int64_t timeOf(FrameIndex index) const override { return index * std::int64_t{40'000}; }

 private:
    VideoInfo info_;
};

/// A recorded run and what is known of its end.
RunFacts facts(FrameSource& source, const SceneScale& scale, const ChainOptions& options = {}) {
    const test::TemporaryFolder folder;
    RunRecorder recorder(folder / "p.eyrie", plannedRun(source.info(), scale, {}, "default"), options);
    const RunRecord run = recorder.finish(ChainRun(options, scale).run(source, {}, recorder, {}));
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    return factsOf(project, run);
}

}  // namespace

TEST(RunFacts, aRunWithTracksSaysHowMany) {
    const test::MovingScene scene;
    test::MemorySource source(scene);
    const RunFacts found = facts(source, sceneScale(source.info(), 0.2));
    EXPECT_EQ(found.state, RunState::finished);
    EXPECT_EQ(found.nothing, NothingFollowed::has_tracks);
    EXPECT_EQ(found.counts.tracks, 2);
    EXPECT_EQ(found.counts.unregistered, 0);
    EXPECT_EQ(found.frames_planned, 40);
    EXPECT_EQ(found.scale_basis, ScaleBasis{ScaleOrigin::given});
}

TEST(RunFacts, theFirstStepThatLeftNothingIsNamed) {
    BlankSource blank;
    const RunFacts unseen = facts(blank, sceneScale(blank.info(), 0.2));
    EXPECT_EQ(unseen.nothing, NothingFollowed::not_registered);
    EXPECT_EQ(unseen.counts.unregistered, 11);
    ASSERT_FALSE(unseen.counts.reasons.empty());

    test::MovingScene empty;
    empty.vehicles.clear();
    test::MemorySource ground(empty);
    EXPECT_EQ(facts(ground, sceneScale(ground.info(), 0.2)).nothing, NothingFollowed::no_motion);

    test::MovingScene passing;  // a vehicle that has left the picture after some forty frames
    passing.frames = 80;
    passing.vehicles = {{{200, 120}, {4.3, 0.6}, {24, 11}}};
    test::MemorySource source(passing);
    ChainOptions options;
    options.tracking.confirm_hits = 64;
    options.tracking.confirm_window = 64;
    EXPECT_EQ(facts(source, sceneScale(source.info(), 0.2), options).nothing, NothingFollowed::none_confirmed);
}

TEST(RunFacts, tooShortAClipForATrackIsNoMatterOfSpeed) {
    test::MovingScene scene;
    const int hits = ChainOptions().tracking.confirm_hits;
    scene.frames = hits;
    test::MemorySource source(scene);
    const RunFacts found = facts(source, sceneScale(source.info(), 0.2));
    EXPECT_EQ(found.nothing, NothingFollowed::too_few_frames);
    EXPECT_EQ(found.frames_needed, hits + 1) << "in the first frame nothing can have moved";

    scene.frames = hits + 1;
    scene.vehicles.clear();
    test::MemorySource enough(scene);
    EXPECT_EQ(facts(enough, sceneScale(enough.info(), 0.2)).nothing, NothingFollowed::no_motion);

    RunFacts coarse = found;
    coarse.gsd_m_per_px = 5;
    EXPECT_EQ(doubtfulScaleOf(coarse), "") << "the scale is not the cause";
    coarse.nothing = NothingFollowed::no_motion;
    EXPECT_NE(doubtfulScaleOf(coarse), "");
}

TEST(RunFacts, theScaleComesFromWhereTheRunWasToldItDoes) {
    const test::TemporaryFolder folder;
    const test::MovingScene scene;
    test::MemorySource source(scene);
    RunRecord planned = plannedRun(source.info(), {0.21, 25, false}, {}, "default");
    planned.scale_basis = {ScaleOrigin::estimated, 1.2, 14};
    const RunRecorder recorder(folder / "p.eyrie", planned, {});
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    EXPECT_EQ(factsOf(project, *RunStore(project).run(1)).scale_basis, planned.scale_basis);
}

TEST(RunFacts, aRunThatNobodyWritesAnyMoreWasStopped) {
    const test::TemporaryFolder folder;
    const test::MovingScene scene;
    test::MemorySource source(scene);
    {
        const RunRecorder killed(folder / "p.eyrie", plannedRun(source.info(), {}, {}, "default"), {});
        ProjectFile project = ProjectFile::open(folder / "p.eyrie");
        EXPECT_EQ(factsOf(project, RunStore(project).runs().front()).state, RunState::running);
    }
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    const RunFacts found = factsOf(project, RunStore(project).runs().front());
    EXPECT_EQ(found.state, RunState::stopped);
    EXPECT_EQ(found.nothing, NothingFollowed::no_frames);
}

}  // namespace eyrie::run_facts_test
