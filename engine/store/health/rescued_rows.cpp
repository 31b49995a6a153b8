#include "store/health/rescued_rows.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "core/time/utc_time.h"
#include "store/backup/database_copy.h"
#include "store/database/rows.h"
#include "store/health/report_text.h"
#include "store/health/row_rules.h"
#include "store/journal/journal_check.h"
#include "store/labels/annotation_store.h"
#include "store/labels/label_rows.h"
#include "store/project/schema.h"
#include "store/review/review_store.h"

namespace eyrie {
namespace {

struct Reference {
    std::string table;
    std::string column;
    std::string parent;
    std::string parent_column;
};

std::vector<Reference> referencesOf(SQLite::Database& database) {
    SQLite::Statement statement(database,
                                "SELECT entry.name, fk.\"from\", fk.\"table\", coalesce(fk.\"to\", 'id') FROM "
                                "sqlite_schema AS entry, pragma_foreign_key_list(entry.name) AS fk WHERE entry.type = "
                                "'table'");
    std::vector<Reference> references;
    while (statement.executeStep()) {
        RowReader row(statement);
        Reference reference;
        reference.table = row.text();
        reference.column = row.text();
        reference.parent = row.text();
        reference.parent_column = row.text();
        references.push_back(std::move(reference));
    }
    return references;
}

/// Numbers of `parent` that rows of other tables name and that are not there.
std::vector<int> lostParents(SQLite::Database& database, const std::vector<Reference>& references,
                             const std::string& parent) {
    std::string query;
    for (const Reference& reference : references) {
        if (reference.parent != parent) continue;
        query += (query.empty() ? "" : " UNION ") + ("SELECT " + reference.column + " AS id FROM " + reference.table);
    }
    SQLite::Statement statement(
        database,
        "SELECT id FROM (" + query + ") WHERE id BETWEEN 1 AND 100000 AND id NOT IN (SELECT id FROM " + parent + ")");
    std::vector<int> ids;
    while (statement.executeStep()) ids.push_back(statement.getColumn(0).getInt());
    return ids;
}

void makeRun(SQLite::Database& database, int id) {
    // It is of the only video if there is one; else of one that is made below.
    SQLite::Statement add(database, R"sql(
INSERT INTO run (id, sequence_id, name, started_utc, engine_version, preset, gsd_m_per_px, gsd_known, frame_rate_hz,
    first_frame, last_frame, state, message)
SELECT ?1, CASE (SELECT count(*) FROM sequence) WHEN 1 THEN (SELECT id FROM sequence)
        ELSE (SELECT coalesce(max(id), 0) + 1 FROM sequence) END, '', ?2, '', '', 0.25, 0, 25,
    coalesce(min(frame), 0), coalesce(max(frame), 0), 'failed', 'its description was lost'
FROM (SELECT frame FROM frame WHERE run_id = ?1 UNION ALL SELECT frame FROM track_state WHERE run_id = ?1)
)sql");
    RowWriter(add).integer(id).text(nowUtc()).run();
}

void makeSequence(SQLite::Database& database, int id) {
    SQLite::Statement add(database, R"sql(
INSERT INTO sequence (id, path, width, height, frame_count, frame_rate_hz)
SELECT ?1, '/lost/video ' || ?1,
    coalesce((SELECT max(frame.width) FROM frame JOIN run ON run.id = run_id WHERE sequence_id = ?1), 1),
    coalesce((SELECT max(frame.height) FROM frame JOIN run ON run.id = run_id WHERE sequence_id = ?1), 1),
    coalesce((SELECT max(last_frame) + 1 FROM run WHERE sequence_id = ?1), 1), 25
)sql");
    RowWriter(add).integer(id).run();
}

}  // namespace

std::vector<std::string> mendScaleOrigins(SQLite::Database& database) {
    const std::string broken = "NOT (" + fittingScaleOrigin() + ")";
    std::vector<std::string> lost;
    for (const std::string& id : textsOf(database, "SELECT id FROM run WHERE " + broken + " ORDER BY id"))
        lost.push_back("where the scale of run " + id + " came from");
    schema::tellScaleOrigins(database, broken);
    return lost;
}

std::vector<std::string> mendScaleSlopes(SQLite::Database& database) {
    const std::string broken = "NOT (" + fittingScaleSlope() + ")";
    std::vector<std::string> lost;
    for (const std::string& id : textsOf(database, "SELECT id FROM run WHERE " + broken + " ORDER BY id"))
        lost.push_back("how the scale of run " + id + " changes over the picture");
    database.exec("UPDATE run SET scale_growth_right = 0, scale_growth_down = 0 WHERE " + broken);
    return lost;
}

std::vector<std::string> mendVideoStarts(SQLite::Database& database) {
    addRowFunctions(database);
    const std::string broken = "NOT (" + fittingVideoStart() + ")";
    std::vector<std::string> lost;
    for (const std::string& id : textsOf(database, "SELECT id FROM sequence WHERE " + broken + " ORDER BY id"))
        lost.push_back("when video " + id + " began");
    database.exec("UPDATE sequence SET start_utc = '' WHERE " + broken);
    return lost;
}

std::vector<std::string> mendRunStarts(SQLite::Database& database) {
    const std::string broken = "NOT (" + fittingRunStart() + ")";
    std::vector<std::string> lost;
    for (const std::string& id : textsOf(database, "SELECT id FROM run WHERE " + broken + " ORDER BY id"))
        lost.push_back("when in its second run " + id + " began");
    database.exec("UPDATE run SET started_fraction_us = NULL WHERE " + broken);
    return lost;
}

std::vector<std::string> dropImpossibleRows(SQLite::Database& database) {
    addRowFunctions(database);
    std::vector<std::string> lost;
    for (const RowRule& rule : rowRules()) {
        const int dropped = database.exec("DELETE FROM " + rule.table + " WHERE NOT (" + rule.condition + ")");
        if (dropped > 0) lost.push_back(counted(dropped, "row") + " of " + rule.table + " left out: " + rule.what);
    }
    return lost;
}

std::vector<std::string> mendReferences(SQLite::Database& database) {
    const auto references = referencesOf(database);
    std::vector<std::string> lost;
    for (const int id : lostParents(database, references, "run")) {
        makeRun(database, id);
        lost.push_back("the description of run " + std::to_string(id) + ": video, scale and parameters");
    }
    for (const int id : lostParents(database, references, "sequence")) {
        makeSequence(database, id);
        lost.push_back("name and frame rate of video " + std::to_string(id));
    }
    for (const Reference& reference : references) {
        const int dropped =
            database.exec("DELETE FROM " + reference.table + " WHERE " + reference.column + " NOT IN (SELECT " +
                          reference.parent_column + " FROM " + reference.parent + ")");
        if (dropped > 0) {
            lost.push_back(counted(dropped, "row") + " of " + reference.table + " left out: their " + reference.parent +
                           " is lost");
        }
    }
    return lost;
}

std::vector<std::string> mendRuns(SQLite::Database& database, bool frames_whole) {
    // As TrackRows adds them up. The score of a track whose row is lost is among what speaks for it.
    database.exec(R"sql(
CREATE TEMP TABLE kept_score AS
SELECT run_id, id, score FROM track WHERE score IS NOT NULL
UNION ALL SELECT run_id, track_id, score FROM track_evidence
    WHERE (run_id, track_id) NOT IN (SELECT run_id, id FROM track);
CREATE INDEX temp.kept_score_of_track ON kept_score (run_id, id);
DELETE FROM track;
INSERT INTO track (run_id, id, first_frame, last_frame, frames, confirmed, speed_sum, length_sum, width_sum, x_sum,
    y_sum, score)
SELECT run_id, track_id, min(frame), max(frame), count(*), max(status <> 'tentative'), sum(sqrt(vx * vx + vy * vy)),
    sum(length), sum(width), sum(x), sum(y),
    (SELECT score FROM kept_score WHERE kept_score.run_id = track_state.run_id AND kept_score.id = track_id)
FROM track_state GROUP BY run_id, track_id;
DROP TABLE kept_score;
)sql");
    stopRunningRuns(database);

    std::vector<std::string> lost;
    SQLite::Statement statement(database, R"sql(
SELECT id, first_frame, coalesce((SELECT max(frame) FROM (
    SELECT max(frame) AS frame FROM frame WHERE run_id = run.id
    UNION ALL SELECT max(frame) FROM track_state WHERE run_id = run.id
    UNION ALL SELECT max(frame) FROM motion_vectors WHERE run_id = run.id
    UNION ALL SELECT last_frame FROM run AS planned WHERE planned.id = run.id AND state = 'finished' AND ?1 = 0)), -1),
    (SELECT count(*) FROM frame WHERE run_id = run.id) FROM run
)sql");
    statement.bind(1, frames_whole ? 1 : 0);
    SQLite::Statement fail(database, "UPDATE run SET state = 'failed', message = ? WHERE id = ?");
    while (statement.executeStep()) {
        RowReader row(statement);
        const int id = row.integer();
        const int first = row.integer();
        const int last = row.integer();
        const int there = row.integer();
        const int expected = last < first ? 0 : last - first + 1;
        if (there >= expected) continue;
        const std::string words = std::to_string(expected - there) + " of " + counted(expected, "frame") +
                                  " were lost when the project was damaged";
        RowWriter(fail).text(words).integer(id).run();
        lost.push_back("run " + std::to_string(id) + ": " + std::to_string(expected - there) + " of " +
                       counted(expected, "frame"));
    }
    return lost;
}

namespace {

template <class Content>
std::vector<std::string> mendWork(SQLite::Database& database) {
    for (const NumberedTable& table : Content::kNumbers) {
        NumberCounter number(table);
        number.read(database);
        number.store(database);
    }
    int dropped = 0;
    for (const std::string& id : textsOf(database, "SELECT id FROM sequence")) {
        const JournalCheck journal = checkJournal<Content>(database, std::stoi(id));
        dropMisfits(database, Content::kSteps, std::stoi(id), journal);
        dropped += journal.done - journal.done_fitting + journal.undone - journal.undone_fitting;
    }
    if (dropped == 0) return {};
    return {counted(dropped, "step") + " of " + Content::kSteps.work + " that could be undone or redone"};
}

}  // namespace

std::vector<std::string> mendLabels(SQLite::Database& database) {
    return mendWork<LabelContent>(database);
}

std::vector<std::string> mendReview(SQLite::Database& database) {
    return mendWork<ReviewContent>(database);
}

}  // namespace eyrie
