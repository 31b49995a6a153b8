#pragma once

#include <SQLiteCpp/Statement.h>

#include <string>
#include <vector>

#include "core/values/frame_result.h"
#include "store/details/unfinished_frames.h"
#include "store/runs/run_store.h"

namespace SQLite {
class Database;
}

namespace eyrie {

/// "INSERT INTO table (…) VALUES (…)" for tables like `track_state`, and what binds a row of it and runs it.
std::string insertState(const std::string& table);
void writeState(SQLite::Statement& statement, int run_id, FrameIndex frame, const TrackState& state);

/// Writes what TracksOfRun tells beyond states and what was left out; nothing of the run may be there.
void insertDoubtful(SQLite::Database& database, int run_id, const TracksOfRun& tracks);

/// What all states of a track have in common.
struct CommonOfTrack {
    FrameIndex first_frame = 0;
    double score = 0;
    bool whole = true;  ///< `score` is that of all of them, and their ages count from `first_frame`
};

/// Adds the states of one frame to a run's tracks, and keeps the sums in table `track` that summaries are read from.
class TrackRows {
 public:
    explicit TrackRows(SQLite::Database& database);
    void insert(int run_id, FrameIndex frame, const TrackState& state);
    /// The same of a finished track: what its states have in common is stored with the track alone.
    void insertFinished(int run_id, FrameIndex frame, TrackState state, const CommonOfTrack& common);
    /// Takes the states of a frame out again, and the tracks that had no others. First and last frames of the others
    /// stay: what comes in place is alike.
    void erase(int run_id, FrameIndex frame);

 private:
    void add(int run_id, FrameIndex frame, const TrackState& state, double score_of_track);
    SQLite::Statement track_;
    SQLite::Statement state_;
    SQLite::Statement forget_states_;
    SQLite::Statement forget_tracks_;
    SQLite::Statement subtract_;
};

/// The prepared statements that add a frame to a run or take it out. The caller owns the transaction. `database` must
/// outlive it.
class FrameRows {
 public:
    explicit FrameRows(SQLite::Database& database);
    /// Without `details`, what is behind the tracks is put aside until the run is finished (UnfinishedFrames). Throws
    /// SQLite::Exception; then the caller's transaction must be rolled back.
    void insert(int run_id, const FrameResult& result, bool details);
    /// Leaves nothing of a frame, there or not. The same errors.
    void erase(int run_id, FrameIndex frame);

 private:
    void insertDetails(int run_id, const FrameResult& result);
    SQLite::Statement frame_;
    SQLite::Statement vectors_;
    SQLite::Statement corners_;
    SQLite::Statement cluster_;
    SQLite::Statement roi_;
    SQLite::Statement detection_;
    UnfinishedFrames unfinished_;
    TrackRows tracks_;
    std::vector<SQLite::Statement> forget_;  ///< one for each table but those of tracks
};

}  // namespace eyrie
