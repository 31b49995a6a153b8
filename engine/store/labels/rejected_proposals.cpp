#include "store/labels/rejected_proposals.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "core/time/utc_time.h"
#include "store/database/rows.h"
#include "store/runs/of_run.h"

namespace eyrie {

std::set<TrackId> rejectedProposals(ProjectFile& project, int run_id) {
    return guarded(project.path(), "reading the rejected proposals" + ofRun(run_id), [&] {
        SQLite::Statement statement(project.database(), "SELECT track_id FROM rejected_proposal WHERE run_id = ?");
        statement.bind(1, run_id);
        std::set<TrackId> tracks;
        while (statement.executeStep()) tracks.insert(RowReader(statement).integer());
        return tracks;
    });
}

void rejectProposals(ProjectFile& project, int run_id, const std::vector<TrackId>& tracks, const std::string& person) {
    project.checkInPlace();
    guarded(project.path(), "storing the rejected proposals" + ofRun(run_id), [&] {
        SQLite::Database& database = project.database();
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        SQLite::Statement add(database,
                              "INSERT INTO rejected_proposal (run_id, track_id, person, when_utc) VALUES (?, ?, ?, ?) "
                              "ON CONFLICT (run_id, track_id) DO NOTHING");
        const std::string now = nowUtc();
        for (const TrackId track : tracks) RowWriter(add).integer(run_id).integer(track).text(person).text(now).run();
        transaction.commit();
    });
}

void forgetRejectedProposals(ProjectFile& project, int run_id) {
    project.checkInPlace();
    guarded(project.path(), "offering the rejected proposals again" + ofRun(run_id), [&] {
        SQLite::Statement forget(project.database(), "DELETE FROM rejected_proposal WHERE run_id = ?");
        RowWriter(forget).integer(run_id).run();
    });
}

}  // namespace eyrie
