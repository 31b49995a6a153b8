#pragma once

#include "core/review/review_edit.h"

namespace SQLite {
class Database;
}

/// Verdicts, bookmarks, zones and corrections in the tables of a project. All throw SQLite::Exception or MalformedRow;
/// the caller guards and, when writing, owns the transaction.
namespace eyrie {

/// All that was said about a video, its zones and corrections; a project of an older schema has none.
ReviewSet readReviewRows(SQLite::Database& database, int sequence_id);

/// Writes what an edit makes of it.
void writeReviewRows(SQLite::Database& database, int sequence_id, const ReviewEdit& edit);

}  // namespace eyrie
