#include "store/review/review_check.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <tuple>
#include <utility>

#include "store/database/rows.h"
#include "store/review/packed_review.h"
#include "store/review/review_rows.h"

namespace eyrie {
namespace {

const char* stepOrder(bool done) {
    return done ? " ORDER BY id DESC" : " ORDER BY id";
}

/// Walks the steps in the order in which undo, or redo, would take them; answers how many there are and fit.
std::pair<int, int> walkSteps(SQLite::Database& database, int sequence_id, bool done) {
    ReviewSet set = readReviewRows(database, sequence_id);
    SQLite::Statement statement(
        database, std::string("SELECT data FROM review_step WHERE sequence_id = ? AND undone = ?") + stepOrder(done));
    statement.bind(1, sequence_id);
    statement.bind(2, done ? 0 : 1);
    int all = 0;
    int fitting = 0;
    while (statement.executeStep()) {
        if (all++ != fitting) continue;
        const auto edit = unpackReview(RowReader(statement).bytes());
        if (!edit) continue;
        try {
            applyEdit(set, done ? inverseOf(*edit) : *edit);
            ++fitting;
        } catch (const Error&) {
        }
    }
    return {all, fitting};
}

void dropStepsBeyond(SQLite::Database& database, int sequence_id, bool done, int fitting) {
    SQLite::Statement drop(database,
                           std::string("DELETE FROM review_step WHERE id IN (SELECT id FROM review_step WHERE "
                                       "sequence_id = ? AND undone = ?") +
                               stepOrder(done) + " LIMIT -1 OFFSET ?)");
    RowWriter(drop).integer(sequence_id).integer(done ? 0 : 1).integer(fitting).run();
}

}  // namespace

JournalCheck checkReview(SQLite::Database& database, int sequence_id) {
    JournalCheck check;
    std::tie(check.done, check.done_fitting) = walkSteps(database, sequence_id, true);
    std::tie(check.undone, check.undone_fitting) = walkSteps(database, sequence_id, false);
    return check;
}

void dropReviewMisfits(SQLite::Database& database, int sequence_id, const JournalCheck& check) {
    dropStepsBeyond(database, sequence_id, true, check.done_fitting);
    dropStepsBeyond(database, sequence_id, false, check.undone_fitting);
}

}  // namespace eyrie
