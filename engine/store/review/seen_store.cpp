#include "store/review/seen_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/database/rows.h"
#include "store/project/sequence_rows.h"

namespace eyrie {
namespace {

std::map<std::string, std::vector<FrameSpan>> readSeen(SQLite::Database& database, int sequence_id) {
    SQLite::Statement statement(database,
                                "SELECT person, first_frame, last_frame FROM seen WHERE sequence_id = ? ORDER BY id");
    statement.bind(1, sequence_id);
    std::map<std::string, std::vector<FrameSpan>> seen;
    while (statement.executeStep()) {
        RowReader row(statement);
        std::vector<FrameSpan>& spans = seen[row.text()];
        FrameSpan span;
        span.first = readFrameNumber(row);
        span.last = readFrameNumber(row);
        if (span.last < span.first) throw MalformedRow{"watched frames end before they begin"};
        spans.push_back(span);
    }
    for (auto& [person, spans] : seen) spans = mergedSpans(std::move(spans));
    return seen;
}

}  // namespace

void addSeen(ProjectFile& project, int sequence_id, const std::string& person, const std::vector<FrameSpan>& seen) {
    const std::vector<FrameSpan> added = mergedSpans(seen);
    if (added.empty()) return;
    project.checkInPlace();
    guarded(project.path(), "storing what was watched", [&] {
        SQLite::Database& database = project.database();
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        // Neighbours, too, so that what follows on stays one row.
        SQLite::Statement touching(database,
                                   "SELECT first_frame, last_frame FROM seen WHERE sequence_id = ?1 AND person = ?2 "
                                   "AND first_frame <= ?4 + 1 AND last_frame >= ?3 - 1");
        SQLite::Statement forget(database,
                                 "DELETE FROM seen WHERE sequence_id = ?1 AND person = ?2 AND first_frame <= ?4 + 1 "
                                 "AND last_frame >= ?3 - 1");
        SQLite::Statement add(database,
                              "INSERT INTO seen (sequence_id, person, first_frame, last_frame) VALUES (?, ?, ?, ?)");
        for (const FrameSpan& span : added) {
            std::vector<FrameSpan> joined{span};
            touching.tryReset();
            touching.bind(1, sequence_id);
            touching.bind(2, person);
            touching.bind(3, span.first);
            touching.bind(4, span.last);
            while (touching.executeStep()) {
                RowReader row(touching);
                FrameSpan before;
                before.first = readFrameNumber(row);
                before.last = readFrameNumber(row);
                joined.push_back(before);
            }
            RowWriter(forget).integer(sequence_id).text(person).integer(span.first).integer(span.last).run();
            for (const FrameSpan& whole : mergedSpans(joined)) {
                RowWriter(add).integer(sequence_id).text(person).integer(whole.first).integer(whole.last).run();
            }
        }
        transaction.commit();
    });
}

std::map<std::string, std::vector<FrameSpan>> seenBy(ProjectFile& project, int sequence_id) {
    return guarded(project.path(), "reading what was watched",
                   [&] { return readSeen(project.database(), sequence_id); });
}

std::vector<FrameSpan> seenByAnybody(ProjectFile& project, int sequence_id) {
    std::vector<FrameSpan> all;
    for (const auto& [person, spans] : seenBy(project, sequence_id)) all.insert(all.end(), spans.begin(), spans.end());
    return mergedSpans(std::move(all));
}

}  // namespace eyrie
