#include "store/database/snapshot.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/database/database_error.h"

namespace eyrie {

Snapshot::Snapshot(ProjectFile& project) : project_(project) {
    guarded(project_.path(), "reading", [&] { project_.database().exec("BEGIN"); });
}

Snapshot::~Snapshot() {
    project_.database().tryExec("ROLLBACK");  // nothing was written
}

}  // namespace eyrie
