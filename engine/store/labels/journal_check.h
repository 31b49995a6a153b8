#pragma once

namespace SQLite {
class Database;
}

namespace eyrie {

/// Which steps of work on the labels of a sequence can still be taken back and done again, one after the other.
struct JournalCheck {
    int done = 0;          ///< steps stored as done
    int undone = 0;        ///< and as undone
    int done_fitting = 0;  ///< of those, from the newest on, that fit the labels
    int undone_fitting = 0;
    bool whole() const { return done == done_fitting && undone == undone_fitting; }
};

/// Reads the labels and every step. Throws SQLite::Exception or MalformedRow when the labels cannot be read.
JournalCheck checkJournal(SQLite::Database& database, int sequence_id);

/// Drops the steps that do not fit, so that undo ends where it must.
void dropMisfits(SQLite::Database& database, int sequence_id, const JournalCheck& check);

}  // namespace eyrie
