#include "store/runs/run_end.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/database/rows.h"
#include "store/runs/of_run.h"

namespace eyrie {

void setEnd(ProjectFile& project, int run_id, FrameIndex last) {
    guarded(project.path(), "storing the end" + ofRun(run_id), [&] {
        SQLite::Transaction transaction(project.database(), SQLite::TransactionBehavior::IMMEDIATE);
        SQLite::Statement run(project.database(), "UPDATE run SET last_frame = ? WHERE id = ?");
        RowWriter(run).integer(last).integer(run_id).run();
        SQLite::Statement video(
            project.database(),
            "UPDATE sequence SET frame_count = ? WHERE id = (SELECT sequence_id FROM run WHERE id = ?)");
        RowWriter(video).integer(last + 1).integer(run_id).run();
        transaction.commit();
    });
}

void setRemark(ProjectFile& project, int run_id, const std::string& remark) {
    guarded(project.path(), "storing a remark" + ofRun(run_id), [&] {
        SQLite::Statement run(project.database(), "UPDATE run SET message = ? WHERE id = ?");
        RowWriter(run).text(remark).integer(run_id).run();
    });
}

}  // namespace eyrie
