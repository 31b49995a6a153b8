#include "store/runs/doubtful_tracks.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <functional>
#include <string>
#include <vector>

#include "store/runs/result_writer.h"
#include "store/samples.h"
#include "support/replaced_tracks.h"
#include "support/temporary_folder.h"

namespace eyrie::doubtful_tracks_test {
namespace {

using test::twoTracks;

int keepStatement(unsigned, void* texts, void* statement, void*) {
    static_cast<std::vector<std::string>*>(texts)->emplace_back(sqlite3_sql(static_cast<sqlite3_stmt*>(statement)));
    return 0;
}

/// How SQLite finds the rows that `reading` reads: a step of its plan a line.
std::string planOf(SQLite::Database& database, const std::function<void()>& reading) {
    std::vector<std::string> texts;
    sqlite3_trace_v2(database.getHandle(), SQLITE_TRACE_STMT, keepStatement, &texts);
    reading();
    sqlite3_trace_v2(database.getHandle(), 0, nullptr, nullptr);
    std::string plan;
    for (const std::string& text : texts) {
        SQLite::Statement steps(database, "EXPLAIN QUERY PLAN " + text);
        while (steps.executeStep()) plan += steps.getColumn(3).getString() + "\n";
    }
    return plan;
}

/// A run whose finishing kept track 1 in frame 5 and left out track 9, in frames 4 and 5, only for its score.
class DoubtfulTracksTest : public testing::Test {
 protected:
    DoubtfulTracksTest() {
        for (const FrameResult& frame : twoTracks()) writer_.write(frame);
        doubtful_.id = 9;
        doubtful_.status = TrackStatus::confirmed;
        doubtful_.score = 0.25;
        evidence_.detected = 0.5;
        evidence_.looked_alike = 0.125;
        evidence_.life_s = 2;
        evidence_.flow_px = 1.5;
        evidence_.flow_ratio = 0.75;
        evidence_.alignment = -0.25;
        evidence_.score = 0.25;
    }

    void finish() {
        TracksOfRun tracks;
        tracks.states = [&](const TracksOfRun::StateVisitor& visitor) {
            TrackState kept = doubtful_;
            kept.id = 1;
            visitor(5, kept);
        };
        tracks.doubtful = [&](const TracksOfRun::StateVisitor& visitor) {
            for (const FrameIndex frame : {4, 5}) visitor(frame, doubtful_);
        };
        tracks.evidence[9] = evidence_;
        store_.replaceTracks(run_, tracks);
    }

    test::TemporaryFolder folder_;
    ProjectFile project_ = ProjectFile::create(folder_ / "clip.eyrie");
    ResultWriter writer_{folder_ / "clip.eyrie", test::sampleRun(), {{"finishing.min_score", "0.35"}}};
    int run_ = writer_.runId();
    RunStore store_{project_};
    TrackState doubtful_ = twoTracks().front().tracks.front();
    TrackEvidence evidence_;
};

TEST_F(DoubtfulTracksTest, AreNoPartOfTheResult) {
    finish();
    ASSERT_EQ(store_.tracks(run_).size(), 1U);
    EXPECT_EQ(store_.tracks(run_).front().id, 1);
    EXPECT_FALSE(store_.tracks(run_).front().doubtful);
    EXPECT_EQ(store_.frameResult(run_, 5)->tracks.size(), 1U);
    EXPECT_EQ(store_.trackBoxes(run_).at(5).size(), 1U);
}

TEST_F(DoubtfulTracksTest, AreReadApart) {
    finish();
    const DoubtfulTracks tracks = store_.doubtful();
    ASSERT_EQ(tracks.summaries(run_).size(), 1U);
    const TrackSummary summary = tracks.summaries(run_).front();
    EXPECT_TRUE(summary.doubtful);
    EXPECT_EQ(summary.id, 9);
    EXPECT_EQ(summary.frames, 2);
    EXPECT_EQ(summary.first_frame, 4);
    EXPECT_EQ(summary.score, 0.25);
    EXPECT_NEAR(summary.mean_length_px, doubtful_.box.length, 1e-9);
    ASSERT_EQ(tracks.statesIn(run_, 5).size(), 1U);
    EXPECT_EQ(tracks.statesIn(run_, 5).front().box.centre, doubtful_.box.centre);
    EXPECT_TRUE(tracks.statesIn(run_, 6).empty());
    EXPECT_EQ(tracks.statesOf(run_, 9).size(), 2U);
    EXPECT_EQ(tracks.statesUpTo(run_, 5, 1).size(), 1U);
    EXPECT_EQ(tracks.boxes(run_).at(4).front().id, 9);
}

TEST_F(DoubtfulTracksTest, TellWhatSpokeForThemAndAgainst) {
    EXPECT_EQ(store_.doubtful().scoreThreshold(run_), 0) << "nothing was judged yet";
    finish();
    EXPECT_EQ(store_.doubtful().scoreThreshold(run_), 0.35);
    EXPECT_FALSE(store_.doubtful().evidence(run_, 1)) << "nothing was kept of it";
    const auto read = store_.doubtful().evidence(run_, 9);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->detected, 0.5);
    EXPECT_EQ(read->looked_alike, 0.125);
    EXPECT_EQ(read->life_s, 2);
    EXPECT_EQ(read->flow_px, 1.5);
    EXPECT_EQ(read->flow_ratio, 0.75);
    EXPECT_EQ(read->alignment, -0.25);
    EXPECT_EQ(read->score, 0.25);
}

// A run over hours leaves out thousands of tracks: who selects one must not wait for the rows of all.
TEST_F(DoubtfulTracksTest, OneIsFoundWithoutReadingTheOthers) {
    finish();
    const DoubtfulTracks tracks = store_.doubtful();
    const std::string states = planOf(project_.database(), [&] { tracks.statesOf(run_, 9); });
    EXPECT_THAT(states, testing::HasSubstr("(run_id=? AND frame=? AND track_id=?)"));
    EXPECT_THAT(states, testing::HasSubstr("doubtful_state_of_track (run_id=? AND track_id=?)"));
    EXPECT_THAT(planOf(project_.database(), [&] { tracks.evidence(run_, 9); }),
                testing::HasSubstr("(run_id=? AND track_id=?)"));
    EXPECT_THAT(planOf(project_.database(), [&] { store_.trackStates(run_, 9); }),
                testing::HasSubstr("track_state USING PRIMARY KEY (run_id=? AND frame=? AND track_id=?)"));
    EXPECT_THAT(planOf(project_.database(), [&] { store_.lastTrackId(run_); }),
                testing::HasSubstr("doubtful_state_of_track"));
}

// The states of one are in the order of frames, and those of others in the same frames are not among them.
TEST_F(DoubtfulTracksTest, StatesOfOneAreItsOwnInTheOrderOfFrames) {
    TracksOfRun tracks;
    tracks.doubtful = [&](const TracksOfRun::StateVisitor& visitor) {
        for (const FrameIndex frame : {4, 5, 7}) {
            for (const TrackId id : {8, 9, 10}) {
                TrackState state = doubtful_;
                state.id = id;
                if (id != 9 || frame != 5) visitor(frame, state);
            }
        }
    };
    store_.replaceTracks(run_, tracks);
    const std::vector<TrackFrame> states = store_.doubtful().statesOf(run_, 9);
    ASSERT_EQ(states.size(), 2U);
    EXPECT_EQ(states[0].frame, 4);
    EXPECT_EQ(states[1].frame, 7);
    EXPECT_EQ(states[0].state.id, 9);
    EXPECT_EQ(states[1].state.id, 9);
    EXPECT_EQ(store_.doubtful().statesOf(run_, 8).size(), 3U);
    EXPECT_TRUE(store_.doubtful().statesOf(run_, 11).empty());
}

TEST_F(DoubtfulTracksTest, GoWithTheTracksThatAreReplaced) {
    finish();
    test::replaceTrackStates(store_, run_, {});
    EXPECT_TRUE(store_.doubtful().summaries(run_).empty());
    EXPECT_FALSE(store_.doubtful().evidence(run_, 9));
}

}  // namespace
}  // namespace eyrie::doubtful_tracks_test
