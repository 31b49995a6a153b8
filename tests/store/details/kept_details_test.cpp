#include "store/details/kept_details.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "store/health/project_check.h"
#include "store/runs/result_writer.h"
#include "store/runs/run_counts.h"
#include "store/samples.h"
#include "support/replaced_tracks.h"
#include "support/temporary_folder.h"

namespace eyrie::kept_details_test {
namespace {

using test::SampleSize;

/// Writes frames of which every `every`-th keeps its details, 0: none.
int writeRun(const std::filesystem::path& path, int frames, int every, RunState state, const SampleSize& size = {}) {
    ProjectFile::openOrCreate(path);
    const std::string details = every == 0 ? "none" : every == 1 ? "all" : "sampled";
    ResultWriter writer(
        path, test::sampleRun(),
        {{"recording.details", details}, {"recording.details_every", std::to_string(std::max(1, every))}});
    for (FrameIndex frame = 0; frame < frames; ++frame) writer.write(test::sampleFrame(frame, size));
    if (state != RunState::running) writer.finish(state, "");
    return writer.runId();
}

class KeptDetails : public testing::Test {
 protected:
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "p.eyrie";
};

TEST_F(KeptDetails, AFrameWithoutThemHasItsTracksAndCountsAndSaysSo) {
    const int run = writeRun(path_, 10, 4, RunState::finished);
    ProjectFile project = ProjectFile::open(path_);
    const RunStore store(project);
    test::expectSame(*store.frameResult(run, 4), test::sampleFrame(4));
    const FrameResult written = test::sampleFrame(5);
    const FrameResult read = store.frameResult(run, 5).value();
    EXPECT_FALSE(hasDetails(project, run, 5));
    EXPECT_TRUE(hasDetails(project, run, 4));
    EXPECT_EQ(read.tracks.size(), written.tracks.size());
    EXPECT_EQ(read.motion.corner_count, written.motion.corner_count);
    EXPECT_EQ(read.motion.registration.current_from_previous.matrix,
              written.motion.registration.current_from_previous.matrix);
    EXPECT_TRUE(read.motion.motion_vectors.empty() && read.motion.stationary_corners.empty() && read.clusters.empty() &&
                read.rois.empty() && read.detections.empty());
    EXPECT_EQ(store.frameSummaries(run)[5].motion_vectors, static_cast<int>(written.motion.motion_vectors.size()));
    EXPECT_EQ(detailedFrames(project, run), 3);
    EXPECT_TRUE(countRun(project, run).any_detection);
    EXPECT_TRUE(checkProject(path_).healthy());
}

TEST_F(KeptDetails, UntilARunIsFinishedItHasWhatFinishingNeeds) {
    const int run = writeRun(path_, 6, 0, RunState::stopped);
    ProjectFile project = ProjectFile::open(path_);
    const RunStore store(project);
    const FrameResult written = test::sampleFrame(3);
    const auto vectors = store.motionVectors(run, 3);
    ASSERT_EQ(vectors.size(), written.motion.motion_vectors.size());
    EXPECT_EQ(vectors.back().position, written.motion.motion_vectors.back().position);
    const int whole = writeRun(path_, 6, 1, RunState::stopped);
    const auto boxes = store.classifiedBoxes(run, 3);
    const auto expected = store.classifiedBoxes(whole, 3);
    ASSERT_EQ(boxes.size(), expected.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        EXPECT_EQ(boxes[i].box.centre, expected[i].box.centre);
        EXPECT_EQ(boxes[i].whole, expected[i].whole);
        EXPECT_TRUE(boxes[i].decision == expected[i].decision ||
                    (std::isnan(boxes[i].decision) && std::isnan(expected[i].decision)));
    }
    EXPECT_TRUE(checkProject(path_).healthy());
}

TEST_F(KeptDetails, ARunThatIsGoneOnWithKeepsToWhatWasSaid) {
    const int run = writeRun(path_, 6, 2, RunState::stopped);
    {
        ResultWriter writer(path_, run, 5);
        for (FrameIndex frame = 6; frame < 12; ++frame) writer.write(test::sampleFrame(frame));
        writer.finish(RunState::finished, "");
    }
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_EQ(detailedFrames(project, run), 6);
    EXPECT_TRUE(hasDetails(project, run, 10));
    EXPECT_FALSE(hasDetails(project, run, 11));
}

TEST_F(KeptDetails, DetectionsThatWereNotKeptAreNotTakenForNone) {
    const int none = writeRun(path_, 4, 0, RunState::finished);
    const int some = writeRun(path_, 4, 2, RunState::finished);
    ProjectFile project = ProjectFile::open(path_);
    const RunStore store(project);
    for (const auto& [run, words] :
         {std::pair(none, "run 1 keeps tracks only"), std::pair(some, "of 2 of 4 frames only")}) {
        try {
            store.detectionBoxes(run);
            FAIL() << "run " << run;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("recording.details=all"), std::string::npos);
        }
    }
    EXPECT_FALSE(store.trackBoxes(none).empty());
}

TEST_F(KeptDetails, WhatWasLeftOutIsCountedWithoutThem) {
    const int run = writeRun(path_, 10, 5, RunState::stopped);
    ProjectFile project = ProjectFile::open(path_);
    RunStore store(project);
    std::vector<std::pair<FrameIndex, DroppedState>> dropped;
    for (FrameIndex frame = 1; frame < 10; ++frame)
        for (const TrackId id : {40, 41}) {
            DroppedState state;
            state.id = id;
            state.why = TrackDrop::shadow;
            dropped.emplace_back(frame, state);
        }
    test::replaceTrackStates(store, run, {}, dropped);
    EXPECT_EQ(countRun(project, run).dropped_tracks, 2);
    EXPECT_EQ(store.frameResult(run, 1)->dropped.size(), 2U) << "the first of each";
    EXPECT_EQ(store.frameResult(run, 5)->dropped.size(), 2U) << "those of a frame with details";
    EXPECT_TRUE(store.frameResult(run, 7)->dropped.empty());
}

TEST_F(KeptDetails, AFinishedRunGivesItsSpaceBack) {
    const SampleSize busy{.stationary_corners = 4000, .motion_vectors = 800};
    writeRun(folder_ / "all.eyrie", 60, 1, RunState::finished, busy);
    writeRun(folder_ / "none.eyrie", 60, 0, RunState::finished, busy);
    const auto all = std::filesystem::file_size(folder_ / "all.eyrie");
    const auto none = std::filesystem::file_size(folder_ / "none.eyrie");
    ProjectFile empty = ProjectFile::create(folder_ / "empty.eyrie");
    const auto nothing = std::filesystem::file_size(folder_ / "empty.eyrie");
    EXPECT_LT((none - nothing) * 10, all - nothing) << none << " of " << all << ", empty " << nothing;
}

}  // namespace
}  // namespace eyrie::kept_details_test
