#pragma once

#include "store/runs/run_store.h"
#include "sweep/sweep_runner.h"

namespace eyrie {

/// Opens a sequence for a sweep: fills in size, frames, digest and how boxes are compared of the planned clip, whose
/// scale must be set. Throws Error(input | parameter), also where no true box lies in the frames.
SweepInput openClip(SweepClip& clip, const ClipFrames::Open& open, FrameRange range, GroundTruth truth,
                    EvaluationOptions wishes, const StageCacheOptions& options = {});

/// A finished or stopped run of a project, to be swept behind its motion vectors.
struct StoredRun {
    SweepClip clip;  ///< all but ground truth and digest
    RunRecord record;
    ChainOptions options;
    FrameRange range;
    std::vector<FrameMotion> motion;  ///< empty where the run keeps no details of some frame
};
/// Throws Error(parameter) when the project has no such run, Error(project) when it has none.
StoredRun readStoredRun(ProjectFile& project, std::optional<int> run_id = {});

/// Sequences as planned and opened.
struct OpenedClips {
    std::vector<SweepClip> clips;
    std::vector<SweepInput> inputs;
    std::vector<std::string> remarks;

    void add(SweepClip clip, SweepInput input);
    /// Adds a run whose motion vectors are used again. Throws as openClip() and readGroundTruth() do.
    void add(StoredRun run, const ClipFrames::Open& open, const GroundTruthSource& truth, ProjectFile& project,
             const EvaluationOptions& wishes, const StageCacheOptions& options = {});
};

}  // namespace eyrie
