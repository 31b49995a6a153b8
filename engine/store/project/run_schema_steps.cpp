#include <SQLiteCpp/SQLiteCpp.h>

#include "store/project/schema_steps.h"

namespace eyrie::schema {

// How far into the second of `started_utc` a run began; not known of those of before. It stands beside it, so that what
// tells the start tells what it did.
void addStartFractions(SQLite::Database& database) {
    database.exec("ALTER TABLE run ADD COLUMN started_fraction_us INTEGER");
}

// How the files of its video lay there when a run began (io/file_digest.h); empty of those of before.
void addSourceDigests(SQLite::Database& database) {
    database.exec("ALTER TABLE run ADD COLUMN source_digest TEXT NOT NULL DEFAULT ''");
}

}  // namespace eyrie::schema
