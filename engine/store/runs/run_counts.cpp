#include "store/runs/run_counts.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>

#include "store/database/rows.h"

namespace eyrie {
namespace {

void countFrames(SQLite::Database& database, int run_id, RunCounts& counts) {
    SQLite::Statement statement(database,
                                "SELECT registration_state, reason, picture, count(*), sum(motion_vector_count), "
                                "sum(detection_count) FROM frame WHERE run_id = ? GROUP BY 1, 2, 3");
    statement.bind(1, run_id);
    while (statement.executeStep()) {
        RowReader row(statement);
        const auto state = row.word(stored::kRegistrationStates);
        const auto fault = row.word(stored::kRegistrationFaults);
        const auto picture = row.word(stored::kPictureQualities);
        const int frames = row.integer();
        counts.frames += frames;
        counts.motion_vectors += static_cast<long>(row.wide());
        counts.detections += static_cast<long>(row.wide());
        if (state != RegistrationState::failed) continue;
        counts.unregistered += frames;
        counts.reasons.push_back({fault, picture, frames});
    }
    std::stable_sort(counts.reasons.begin(), counts.reasons.end(),
                     [](const ReasonCount& a, const ReasonCount& b) { return a.frames > b.frames; });
}

int number(SQLite::Database& database, const char* query, int run_id) {
    SQLite::Statement statement(database, query);
    statement.bind(1, run_id);
    statement.executeStep();
    return statement.getColumn(0).getInt();
}

}  // namespace

RunCounts countRun(ProjectFile& project, int run_id) {
    return guarded(project.path(), "counting run " + std::to_string(run_id), [&] {
        SQLite::Database& database = project.database();
        SQLite::Transaction moment(database);
        RunCounts counts;
        countFrames(database, run_id, counts);
        counts.any_detection =
            counts.detections > 0 ||
            number(database, "SELECT EXISTS (SELECT 1 FROM detection WHERE run_id = ?)", run_id) != 0;
        counts.tracks = number(database, "SELECT count(*) FROM track WHERE run_id = ? AND confirmed <> 0", run_id);
        counts.dropped_tracks = number(
            database, "SELECT count(DISTINCT track_id) FROM dropped_state WHERE run_id = ? AND reason <> 'unconfirmed'",
            run_id);
        return counts;
    });
}

}  // namespace eyrie
