#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "store/database/rows.h"
#include "store/journal/step_journal.h"

namespace eyrie {

/// Which steps of a kind of work on a video can still be taken back and done again, one after the other.
struct JournalCheck {
    int done = 0;          ///< steps stored as done
    int undone = 0;        ///< and as undone
    int done_fitting = 0;  ///< of those, from the newest on, that fit what is there
    int undone_fitting = 0;
    bool whole() const { return done == done_fitting && undone == undone_fitting; }
};

/// Drops the steps that do not fit, so that undo ends where it must. Throws SQLite::Exception.
void dropMisfits(SQLite::Database& database, const StepTable& table, int sequence_id, const JournalCheck& check);

/// The rows of the steps in the order in which undo, or redo, takes them: " WHERE … ORDER BY …", with the id of the
/// video as the parameter.
std::string stepsInOrder(const StepTable& table, bool done);

/// Reads what is there and every step. `Content`: see journalled_store.h. Throws SQLite::Exception or MalformedRow when
/// what is there cannot be read.
template <class Content>
JournalCheck checkJournal(SQLite::Database& database, int sequence_id) {
    const auto walk = [&](bool done) {
        auto set = Content::read(database, sequence_id);
        SQLite::Statement statement(database, "SELECT data" + stepsInOrder(Content::kSteps, done));
        statement.bind(1, sequence_id);
        int all = 0;
        int fitting = 0;
        while (statement.executeStep()) {
            if (all++ != fitting) continue;
            const auto edit = Content::unpack(RowReader(statement).bytes(), set, done);
            if (!edit) continue;
            try {
                applyEdit(set, done ? inverseOf(*edit) : *edit);
                ++fitting;
            } catch (const Error&) {
                // One step that does not fit ends the walk, as it would end undo.
            }
        }
        return std::pair(all, fitting);
    };
    JournalCheck check;
    std::tie(check.done, check.done_fitting) = walk(true);
    std::tie(check.undone, check.undone_fitting) = walk(false);
    return check;
}

}  // namespace eyrie
