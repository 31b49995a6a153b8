#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chain/chain_options.h"
#include "chain/chain_run.h"
#include "core/error.h"
#include "store/runs/run_store.h"

namespace eyrie::cli {

/// What `run --resume` was told; only what stands on the command line counts.
struct ResumeWishes {
    std::string video;  ///< as a project stores it; empty: any
    std::optional<int> run;
    std::optional<double> gsd_m_per_px;
    std::optional<double> frame_rate_hz;
    std::optional<FrameRange> frames;
    std::optional<ChainOptions> options;
    std::vector<std::pair<std::string, std::string>> recording;  ///< parameters of what is kept that were set
};

/// The run that `run --resume` is about.
struct ResumeChoice {
    std::optional<RunRecord> run;  ///< to be gone on with, or finished; nothing: begin a new one
    std::string why_new;           ///< for people; may be empty
};

/// By its number, or the newest of the project that is not finished; with a video but no number the newest run of that
/// video that was begun with what is wished, finished or not, so that a command given again with --resume does what is
/// left of it. Throws Error(parameter) when there is no such run, or it was begun with something else than is wished.
ResumeChoice chooseRun(const RunStore& store, const std::string& project, const ResumeWishes& wishes);

/// The run that was wished for was begun by another program meanwhile, and finished: nothing is left to do.
class FinishedMeanwhile : public Error {
 public:
    FinishedMeanwhile(RunRecord finished, const std::string& project)
        : Error(ErrorKind::project, "run " + std::to_string(finished.id) + " of " + project +
                                        " was finished by another program meanwhile: nothing is left to do"),
          run(std::move(finished)) {}

    RunRecord run;
};

/// Asked before a run is added where chooseRun() had found none: throws FinishedMeanwhile, or Error(project) with what
/// to do, where another program began what is wished meanwhile.
void checkNotBegun(const RunStore& store, const std::string& project, const ResumeWishes& wishes);

/// Throws Error(input) unless a run that is gone on with will have the detections of all its frames, or has them.
void needDetections(ProjectFile& project, const RunRecord& run);

}  // namespace eyrie::cli
