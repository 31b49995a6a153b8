#include "store/runs/run_counts.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>

#include "store/database/rows.h"

namespace eyrie {
namespace {

/// "too few corners (12 of 40)" and "too few corners (9 of 40)" are one reason.
std::string withoutFigures(const std::string& reason) {
    return reason.substr(0, reason.find(" ("));
}

void countFrames(SQLite::Database& database, int run_id, RunCounts& counts) {
    SQLite::Statement statement(database,
                                "SELECT registration_state, reason, count(*), sum(motion_vector_count), "
                                "sum(detection_count) FROM frame WHERE run_id = ? GROUP BY 1, 2");
    statement.bind(1, run_id);
    while (statement.executeStep()) {
        RowReader row(statement);
        const auto state = row.word(stored::kRegistrationStates);
        const std::string reason = withoutFigures(row.text());
        const int frames = row.integer();
        counts.frames += frames;
        counts.motion_vectors += static_cast<long>(row.wide());
        counts.detections += static_cast<long>(row.wide());
        if (state != RegistrationState::failed) continue;
        counts.unregistered += frames;
        const auto known = std::find_if(counts.reasons.begin(), counts.reasons.end(),
                                        [&](const ReasonCount& count) { return count.reason == reason; });
        if (known != counts.reasons.end())
            known->frames += frames;
        else
            counts.reasons.push_back({reason, frames});
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
            number(database, "SELECT EXISTS (SELECT 1 FROM detection WHERE run_id = ?)", run_id) != 0;
        counts.tracks = number(database, "SELECT count(*) FROM track WHERE run_id = ? AND confirmed <> 0", run_id);
        counts.dropped_tracks = number(
            database, "SELECT count(DISTINCT track_id) FROM dropped_state WHERE run_id = ? AND reason <> 'unconfirmed'",
            run_id);
        return counts;
    });
}

}  // namespace eyrie
