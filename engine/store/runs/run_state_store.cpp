#include "store/runs/run_state_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/database/rows.h"
#include "store/runs/of_run.h"

namespace eyrie {
namespace {

void runFor(SQLite::Database& database, const std::string& command, int run_id) {
    SQLite::Statement statement(database, command);
    RowWriter(statement).integer(run_id).run();
}

/// Makes the run one that is being written, if it is still as it was when it was looked at.
void claim(ProjectFile& project, int run_id, FrameIndex last) {
    SQLite::Statement statement(project.database(),
                                "UPDATE run SET state = 'running', message = '' WHERE id = ?1 AND state <> 'finished' "
                                "AND removed_utc = '' AND (SELECT count(*) FROM frame WHERE run_id = ?1 AND frame <= "
                                "?2) = ?2 - first_frame + 1");
    RowWriter(statement).integer(run_id).integer(last).run();
    if (project.database().getChanges() > 0) return;
    throw Error(ErrorKind::project, "run " + std::to_string(run_id) + " of " + project.path().string() +
                                        " was finished, removed or changed by another program meanwhile; look at it "
                                        "again");
}

/// What tables and lists sum up of the tracks.
void sumUpTracks(SQLite::Database& database, int run_id) {
    for (const char* table :
         {"dropped_state", "doubtful_state", "track_evidence", "light_finding", "frame_shadow", "box_trim", "track"})
        runFor(database, std::string("DELETE FROM ") + table + " WHERE run_id = ?", run_id);
    runFor(
        database,
        "INSERT INTO track (run_id, id, first_frame, last_frame, frames, confirmed, speed_sum, length_sum, width_sum, "
        "x_sum, y_sum) SELECT run_id, track_id, min(frame), max(frame), count(*), max(status <> 'tentative'), "
        "sum(sqrt(vx * vx + vy * vy)), sum(length), sum(width), sum(x), sum(y) FROM track_state WHERE run_id = ? GROUP "
        "BY track_id",
        run_id);
    runFor(database,
           "UPDATE frame SET track_count = (SELECT count(*) FROM track_state WHERE track_state.run_id = frame.run_id "
           "AND track_state.frame = frame.frame AND status <> 'tentative') WHERE run_id = ?",
           run_id);
}

void restoreTracks(SQLite::Database& database, int run_id) {
    SQLite::Statement any(database, "SELECT EXISTS (SELECT 1 FROM unfinished_track_state WHERE run_id = ?)");
    any.bind(1, run_id);
    any.executeStep();
    if (any.getColumn(0).getInt() == 0) return;  // they were never finished
    runFor(database, "DELETE FROM track_state WHERE run_id = ?", run_id);
    runFor(database, "INSERT INTO track_state SELECT * FROM unfinished_track_state WHERE run_id = ?", run_id);
    runFor(database, "DELETE FROM unfinished_track_state WHERE run_id = ?", run_id);
    sumUpTracks(database, run_id);
}

}  // namespace

std::optional<StoredRunState> RunStateStore::newest(int run_id) const {
    return guarded(project_.path(), "reading the state" + ofRun(run_id), [&]() -> std::optional<StoredRunState> {
        SQLite::Statement statement(project_.database(), "SELECT frame, data FROM run_state WHERE run_id = ?");
        statement.bind(1, run_id);
        if (!statement.executeStep()) return std::nullopt;
        RowReader row(statement);
        StoredRunState state;
        state.frame = row.integer();
        const ByteView data = row.bytes();
        state.bytes.assign(reinterpret_cast<const char*>(data.data()), data.size());
        return state;
    });
}

void RunStateStore::keep(int run_id, FrameIndex frame, const std::string& bytes) {
    if (bytes.size() > kLargestRunState) return;
    guarded(project_.path(), "keeping the state" + ofRun(run_id), [&] {
        SQLite::Statement statement(project_.database(),
                                    "INSERT OR REPLACE INTO run_state (run_id, frame, data) VALUES (?, ?, ?)");
        statement.bind(1, run_id);
        statement.bind(2, frame);
        statement.bindNoCopy(3, bytes.data(), static_cast<int>(bytes.size()));
        statement.exec();
    });
}

void RunStateStore::keepTracks(int run_id) {
    guarded(project_.path(), "keeping the tracks" + ofRun(run_id), [&] {
        SQLite::Database& database = project_.database();
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        runFor(database, "DELETE FROM unfinished_track_state WHERE run_id = ?", run_id);
        runFor(database, "INSERT INTO unfinished_track_state SELECT * FROM track_state WHERE run_id = ?", run_id);
        transaction.commit();
    });
}

FrameIndex RunStateStore::takeUp(int run_id, FrameIndex last) {
    return guarded(project_.path(), "taking up" + ofRun(run_id) + " after frame " + std::to_string(last), [&] {
        SQLite::Database& database = project_.database();
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        claim(project_, run_id, last);
        restoreTracks(database, run_id);
        SQLite::Statement stored(database, "SELECT ifnull(max(frame), ?) FROM frame WHERE run_id = ?");
        stored.bind(1, last);
        stored.bind(2, run_id);
        stored.executeStep();
        const FrameIndex last_stored = stored.getColumn(0).getInt();
        transaction.commit();
        return last_stored;
    });
}

}  // namespace eyrie
