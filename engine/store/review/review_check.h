#pragma once

#include "store/labels/journal_check.h"

namespace eyrie {

/// Which steps of reviewing a video can still be taken back and done again. Reads the verdicts and every step. Throws
/// SQLite::Exception or MalformedRow when the verdicts cannot be read.
JournalCheck checkReview(SQLite::Database& database, int sequence_id);

/// Drops the steps that do not fit, so that undo ends where it must.
void dropReviewMisfits(SQLite::Database& database, int sequence_id, const JournalCheck& check);

}  // namespace eyrie
