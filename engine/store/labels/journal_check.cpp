#include "store/labels/journal_check.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "core/labels/annotation_edit.h"
#include "store/database/rows.h"
#include "store/labels/label_rows.h"
#include "store/labels/packed_labels.h"

namespace eyrie {
namespace {

const char* orderOf(bool done) {
    return done ? " ORDER BY id DESC" : " ORDER BY id";
}

/// Walks the steps in the order in which undo, or redo, would take them; answers how many there are and fit.
std::pair<int, int> walk(SQLite::Database& database, int sequence_id, bool done) {
    AnnotationSet set = readLabels(database, sequence_id);
    SQLite::Statement statement(
        database, std::string("SELECT data FROM edit_journal WHERE sequence_id = ? AND undone = ?") + orderOf(done));
    statement.bind(1, sequence_id);
    statement.bind(2, done ? 0 : 1);
    int all = 0;
    int fitting = 0;
    while (statement.executeStep()) {
        if (all++ != fitting) continue;
        const auto edit = unpackEdit(RowReader(statement).bytes(), set, done);
        if (!edit) continue;
        try {
            applyEdit(set, done ? inverseOf(*edit) : *edit);
            ++fitting;
        } catch (const Error&) {
        }
    }
    return {all, fitting};
}

void dropBeyond(SQLite::Database& database, int sequence_id, bool done, int fitting) {
    SQLite::Statement drop(database,
                           std::string("DELETE FROM edit_journal WHERE id IN (SELECT id FROM edit_journal WHERE "
                                       "sequence_id = ? AND undone = ?") +
                               orderOf(done) + " LIMIT -1 OFFSET ?)");
    RowWriter(drop).integer(sequence_id).integer(done ? 0 : 1).integer(fitting).run();
}

}  // namespace

JournalCheck checkJournal(SQLite::Database& database, int sequence_id) {
    JournalCheck check;
    std::tie(check.done, check.done_fitting) = walk(database, sequence_id, true);
    std::tie(check.undone, check.undone_fitting) = walk(database, sequence_id, false);
    return check;
}

void dropMisfits(SQLite::Database& database, int sequence_id, const JournalCheck& check) {
    dropBeyond(database, sequence_id, true, check.done_fitting);
    dropBeyond(database, sequence_id, false, check.undone_fitting);
}

}  // namespace eyrie
