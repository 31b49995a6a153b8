#include "store/journal/journal_check.h"

namespace eyrie {

std::string stepsInOrder(const StepTable& table, bool done) {
    return std::string(" FROM ") + table.name + " WHERE sequence_id = ? AND undone = " + (done ? "0" : "1") +
           (done ? " ORDER BY id DESC" : " ORDER BY id");
}

void dropMisfits(SQLite::Database& database, const StepTable& table, int sequence_id, const JournalCheck& check) {
    for (const bool done : {true, false}) {
        SQLite::Statement drop(database, std::string("DELETE FROM ") + table.name + " WHERE id IN (SELECT id" +
                                             stepsInOrder(table, done) + " LIMIT -1 OFFSET ?)");
        RowWriter(drop).integer(sequence_id).integer(done ? check.done_fitting : check.undone_fitting).run();
    }
}

}  // namespace eyrie
