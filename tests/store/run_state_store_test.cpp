#include "store/runs/run_state_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "core/error.h"
#include "store/journal/step_journal.h"
#include "store/runs/result_writer.h"
#include "store/samples.h"
#include "support/run_rows.h"
#include "support/temporary_folder.h"

namespace eyrie::run_state_store_test {
namespace {

using testing::HasSubstr;

/// A project with a run of the sample's frames, ended in a state.
class RunStates : public testing::Test {
 protected:
    int write(int frames, RunState state) const {
        ProjectFile::openOrCreate(path);
        ResultWriter writer(path, test::sampleRun(), {});
        for (int frame = 0; frame < frames; ++frame) writer.write(test::sampleFrame(frame));
        writer.finish(state, state == RunState::failed ? "no space left" : "");
        return writer.runId();
    }
    const test::TemporaryFolder folder;
    const std::filesystem::path path = folder / "clip.eyrie";
};

/// Without the sums over tracks, which may differ in their last bits.
std::vector<std::string> rowsOf(const std::filesystem::path& path, int run) {
    std::vector<std::string> rows = test::rowsOf(path, run);
    std::erase_if(rows, [](const std::string& row) { return row.starts_with("track:"); });
    return rows;
}

}  // namespace

TEST_F(RunStates, WhatIsTooLargeForARowIsKnownBeforeItIsWritten) {
    ProjectFile project = ProjectFile::openOrCreate(path);
    const int longest_row = sqlite3_limit(project.database().getHandle(), SQLITE_LIMIT_LENGTH, -1);
    EXPECT_LT(kLargestRunState, static_cast<std::size_t>(longest_row));
    EXPECT_LT(kLargestStep, static_cast<std::size_t>(longest_row));
}

TEST_F(RunStates, KeepTheNewestAlone) {
    const int run = write(3, RunState::stopped);
    ProjectFile project = ProjectFile::open(path);
    RunStateStore states(project);
    EXPECT_FALSE(states.newest(run));
    const std::string bytes("a\0b", 3);
    states.keep(run, 1, "older");
    states.keep(run, 2, bytes);
    ASSERT_TRUE(states.newest(run));
    EXPECT_EQ(states.newest(run)->frame, 2);
    EXPECT_EQ(states.newest(run)->bytes, bytes);
}

TEST_F(RunStates, ARunTakenUpKeepsWhatWasDone) {
    const int run = write(9, RunState::failed);
    const auto before = rowsOf(path, run);
    { const ResultWriter writer(path, run, 4); }
    EXPECT_EQ(rowsOf(path, run), before) << "also what comes after the frame to go on from";
    ProjectFile project = ProjectFile::open(path);
    const auto record = RunStore(project).run(run);
    EXPECT_EQ(record->state, RunState::running);
    EXPECT_EQ(record->message, "");
}

TEST_F(RunStates, FramesDoneAgainReplaceThoseBefore) {
    const int run = write(9, RunState::failed);
    const auto before = rowsOf(path, run);
    {
        ResultWriter writer(path, run, 4);
        FrameResult other = test::sampleFrame(5);
        other.tracks.resize(1);
        other.tracks[0].id = 4711;
        other.clusters.clear();
        other.detections.clear();
        other.motion.motion_vectors.clear();
        writer.write(other);
    }
    ProjectFile project = ProjectFile::open(path);
    const RunStore store(project);
    const FrameResult read = store.frameResult(run, 5).value();
    EXPECT_TRUE(read.detections.empty());
    EXPECT_TRUE(read.motion.motion_vectors.empty());
    ASSERT_EQ(read.tracks.size(), 1U);
    EXPECT_EQ(store.run(run)->frames_done, 9);
    for (const TrackSummary& track : store.tracks(run)) {
        EXPECT_EQ(static_cast<std::size_t>(track.frames), store.trackStates(run, track.id).size());
    }
    {
        ResultWriter writer(path, run, 4);
        for (int frame = 5; frame < 9; ++frame) writer.write(test::sampleFrame(frame));
    }
    EXPECT_EQ(rowsOf(path, run), before) << "nothing stays of the track that was there for a while";
    for (const TrackSummary& track : store.tracks(run)) EXPECT_NE(track.id, 4711);
}

TEST_F(RunStates, TakingUpUndoesFinishedTracks) {
    const int run = write(5, RunState::stopped);
    const auto before = rowsOf(path, run);
    ProjectFile project = ProjectFile::open(path);
    RunStateStore(project).keepTracks(run);
    TracksOfRun tracks;
    tracks.dropped = [](const TracksOfRun::DropVisitor& visitor) { visitor(2, {}); };
    tracks.doubtful = [](const TracksOfRun::StateVisitor& visitor) { visitor(2, {}); };
    tracks.evidence[1] = {};
    RunStore(project).replaceTracks(run, tracks);
    EXPECT_NE(rowsOf(path, run), before);
    { const ResultWriter writer(path, run, 4); }
    EXPECT_EQ(rowsOf(path, run), before);
}

TEST_F(RunStates, AFinishedRunNeedsNothing) {
    const int run = write(3, RunState::stopped);
    ResultWriter writer(path, run, 2);
    writer.keepState(2, "state");
    ProjectFile project = ProjectFile::open(path);
    RunStateStore(project).keepTracks(run);
    writer.finish(RunState::finished, "");
    EXPECT_FALSE(RunStateStore(project).newest(run));
    EXPECT_THAT(rowsOf(path, run), testing::Not(testing::Contains(HasSubstr("unfinished_track_state"))));
}

TEST_F(RunStates, RefuseARunThatIsNotAsItWasFound) {
    const int finished = write(3, RunState::finished);
    const int stopped = write(3, RunState::stopped);
    const auto refusal = [&](int run, FrameIndex last) -> std::string {
        try {
            const ResultWriter writer(path, run, last);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::project);
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal(finished, 2), HasSubstr("meanwhile"));
    EXPECT_THAT(refusal(stopped, 5), HasSubstr("meanwhile")) << "frames are missing";
    EXPECT_THAT(refusal(77, 2), HasSubstr("run 77"));
    const ResultWriter writer(path, stopped, 2);
    EXPECT_THAT(refusal(stopped, 2), HasSubstr("is being written by process"));
    ProjectFile project = ProjectFile::open(path);
    EXPECT_TRUE(RunStore(project).run(stopped)->live);
}

}  // namespace eyrie::run_state_store_test
