#include <SQLiteCpp/SQLiteCpp.h>

#include "store/project/schema_steps.h"

namespace eyrie::schema {

// Tracks that an annotator does not want to be offered as objects again. They go with their run.
void addRejectedProposals(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE rejected_proposal (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    track_id INTEGER NOT NULL,
    person TEXT NOT NULL,
    when_utc TEXT NOT NULL,
    PRIMARY KEY (run_id, track_id)
) WITHOUT ROWID;
)sql");
}

}  // namespace eyrie::schema
