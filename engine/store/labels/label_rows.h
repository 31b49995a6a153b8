#pragma once

#include "core/labels/annotation_edit.h"

namespace SQLite {
class Database;
}

/// Labels in the tables of a project. All throw SQLite::Exception or MalformedRow; the caller guards and, when writing,
/// owns the transaction.
namespace eyrie {

/// All labels of a sequence.
AnnotationSet readLabels(SQLite::Database& database, int sequence_id);

/// Writes what an edit makes of the labels; `after` is the set with the edit applied.
void writeLabels(SQLite::Database& database, int sequence_id, const AnnotationEdit& edit, const AnnotationSet& after);

/// Counters of the project: "object" and "region" (the next number), "change". 0 when never set.
std::int64_t readCounter(SQLite::Database& database, const char* kind);
/// The same as a number that can be counted on from, also where the counter is damaged.
int readNextNumber(SQLite::Database& database, const char* kind);
/// Sets a counter unless it is higher already.
void raiseCounter(SQLite::Database& database, const char* kind, std::int64_t value);

}  // namespace eyrie
