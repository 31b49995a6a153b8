#include "store/runs/source_digest.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/database/rows.h"
#include "store/runs/of_run.h"

namespace eyrie {

std::string sourceDigestOf(ProjectFile& project, int run_id) {
    return guarded(project.path(), "reading the digest of the video" + ofRun(run_id), [&]() -> std::string {
        // One that is none is as good as unknown.
        SQLite::Statement statement(project.database(),
                                    "SELECT source_digest FROM run WHERE id = ? AND length(source_digest) = 64");
        statement.bind(1, run_id);
        return statement.executeStep() ? RowReader(statement).text() : std::string();
    });
}

void storeSourceDigest(ProjectFile& project, int run_id, const std::string& digest) {
    guarded(project.path(), "storing the digest of the video" + ofRun(run_id), [&] {
        SQLite::Statement statement(project.database(), "UPDATE run SET source_digest = ? WHERE id = ?");
        RowWriter(statement).text(digest).integer(run_id).run();
    });
}

}  // namespace eyrie
