#include "store/details/kept_details.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/database/database_error.h"
#include "store/runs/of_run.h"

namespace eyrie {

bool hasDetails(ProjectFile& project, int run_id, FrameIndex frame) {
    return guarded(project.path(), "reading frame " + std::to_string(frame) + ofRun(run_id), [&] {
        SQLite::Statement statement(project.database(), "SELECT details FROM frame WHERE run_id = ? AND frame = ?");
        statement.bind(1, run_id);
        statement.bind(2, frame);
        return !statement.executeStep() || statement.getColumn(0).getInt() != 0;
    });
}

int detailedFrames(ProjectFile& project, int run_id) {
    return guarded(project.path(), "counting the frames" + ofRun(run_id), [&] {
        SQLite::Statement statement(project.database(), "SELECT count(*) FROM frame WHERE run_id = ? AND details <> 0");
        statement.bind(1, run_id);
        statement.executeStep();
        return statement.getColumn(0).getInt();
    });
}

std::string lackOfDetails(const RunRecord& run, int kept) {
    const std::string which = "run " + std::to_string(run.id);
    const std::string of = kept == 0 ? "keeps tracks only"
                                     : "keeps what is behind its tracks of " + std::to_string(kept) + " of " +
                                           std::to_string(run.frames_done) + " frames only";
    return which + " " + of +
           " (recording.details): its motion vectors, corners, clusters, search areas and detections are not there" +
           (kept == 0 ? "" : " for the others") + "; make a run over the frames in question with recording.details=all";
}

void needDetails(ProjectFile& project, const RunRecord& run) {
    const int kept = detailedFrames(project, run.id);
    if (kept < run.frames_done) throw Error(ErrorKind::input, lackOfDetails(run, kept));
}

}  // namespace eyrie
