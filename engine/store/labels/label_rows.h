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

}  // namespace eyrie
