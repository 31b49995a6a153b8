#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "chain/chain_run.h"
#include "io/video/frame_source.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// Why a run cannot be gone on with.
enum class ResumeObstacle {
    none,
    finished,         ///< nothing is left to do
    live,             ///< another program writes it at this moment
    other_engine,     ///< another version of the engine began it: its frames would not go together
    other_parameters  ///< it has parameters that this engine does not know, or lacks some
};
/// One sentence for people, without the run's number; empty for none.
std::string textOf(ResumeObstacle obstacle);

/// Why a run cannot be gone on with, as far as its project tells.
ResumeObstacle resumeObstacle(const RunStore& store, const RunRecord& run);
/// The runs of a project that ended early and can be gone on with, newest first.
std::vector<RunRecord> resumableRuns(const RunStore& store);

/// Why a run begins again at its first frame.
enum class RestartReason {
    none,           ///< it goes on where it was left
    nothing_kept,   ///< it ended before anything was kept, or an older Eyrie made it
    damaged_state,  ///< what was kept cannot be used
};

/// A run that is ready to be gone on with. The result is that of a run that never ended early, to the last bit.
struct ResumedRun {
    RunRecord run;  ///< as it will be: running
    ChainOptions options;
    FrameIndex last_done = -1;  ///< frames up to here stay as they are; those behind it are done again
    RestartReason restart = RestartReason::none;
    RunStart start;

    FrameRange range() const { return {run.first_frame, run.last_frame}; }
};

/// Makes a run ready. `source` is the run's video (RunRecord::sequence), opened again; some of its frames are read.
/// The project is only read; RunRecorder changes it. Throws Error(parameter) for a run that does not exist or cannot
/// be gone on with, Error(input) when the video or the classifier's file is not what it was, Error(project).
ResumedRun resumedRun(const std::filesystem::path& project, int run_id, FrameSource& source);

}  // namespace eyrie
