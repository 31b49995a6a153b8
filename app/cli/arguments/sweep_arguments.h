#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "cli/arguments/evaluation_arguments.h"
#include "cli/arguments/video_arguments.h"
#include "sweep/clip_opening.h"

namespace eyrie::cli {

/// Where sequences and ground truth of a sweep come from, as named on the command line.
struct SweepSources {
    std::vector<std::string> sequences;
    std::vector<std::string> ground_truths;  ///< one for each sequence; of a project, one for each run or none
    std::vector<double> gsds;                ///< one for all, or one for each sequence
    GroundTruthArguments ground_truth;       ///< only where MOTChallenge text begins
    EvaluationArguments evaluation;
    VideoArguments video;   ///< without a GSD
    std::string project;    ///< in place of sequences
    std::vector<int> runs;  ///< of the project; none: its last
};

/// Opens video files, folders and scenes; `options` are used where the scale must be estimated. `project` may remember
/// their frame rates; it need not exist. Throws Error.
OpenedClips openSequences(const SweepSources& sources, const ChainOptions& options, const std::string& project,
                          std::stop_token stop);

/// Opens stored runs, whose motion vectors are used unless `options` make others. Ground truth is a file for each, or
/// the labels of the project. Throws Error.
OpenedClips openStoredRuns(const SweepSources& sources, std::vector<StoredRun> runs, const ChainOptions& options);

}  // namespace eyrie::cli
