#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "diagnosis/diagnoser.h"
#include "evaluation/comparison/method_difference.h"
#include "evaluation/comparison/track_bootstrap.h"
#include "evaluation/evaluate.h"
#include "evaluation/measures/score_curve.h"
#include "scoring/ground_truth.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// What is to be measured, and against what.
struct EvaluationRequest {
    std::filesystem::path project;
    int run_id = 0;
    bool detections = false;  ///< the run's detections instead of its tracks
    GroundTruthSource truth;
    std::vector<double> overlaps{0.1, 0.2, 0.3};  ///< T_ov of the table
    EvaluationOptions options;                    ///< wishes; the overlap is that of errors, curves and objects
    std::optional<int> other_run;                 ///< to be compared with, over the frames both reached
    bool with_causes = true;
};

/// What happened in one frame.
struct FrameCounts {
    FrameIndex frame = 0;
    int found = 0;
    int missed = 0;
    int false_alarms = 0;
};

/// The run against another one on the same ground truth.
struct RunDifference {
    RunRecord other;
    MethodDifference difference;  ///< this one − the other
};

/// Everything known about how good a run is.
struct RunEvaluation {
    RunRecord run;
    bool detections = false;
    std::vector<std::pair<std::string, std::string>> parameters;  ///< of the run
    std::string truth_name;
    EvaluationOptions options;  ///< as used; `overlap` is the shown one
    BoxesByFrame truth;         ///< of the frames compared
    BoxesByFrame result;
    std::vector<Measures> table;  ///< one for each T_ov asked for
    Measures shown;               ///< at the shown T_ov
    std::vector<FrameMatch> matches;
    std::vector<FrameCounts> frames;
    std::vector<DiagnosedError> errors;
    BootstrapInterval f_score;
    std::optional<BootstrapInterval> mota;
    std::optional<RunDifference> difference;
    std::vector<std::string> remarks;
};

/// Evaluates runs of projects, and keeps what it read of the last run, so that scoring again after a change of labels
/// or options is quick. For one thread.
class RunEvaluator {
 public:
    RunEvaluator();
    ~RunEvaluator();
    /// Nothing when `stop` was requested. Throws Error(input | project) when there is nothing to compare with, saying
    /// why and what to do; Error(project | parameter) as the stores and evaluate() do.
    std::shared_ptr<const RunEvaluation> evaluate(const EvaluationRequest& request, const std::stop_token& stop = {});

 private:
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

/// Precision and recall over the score, at the shown T_ov; tracks that only their score kept out of the result are
/// counted, too, so that the curve goes on below the run's own threshold. Throws as RunEvaluator does.
std::vector<ScorePoint> scoreCurveOf(const RunEvaluation& evaluation, const RunStore& store,
                                     const std::stop_token& stop = {});

/// What a stored run tells about causes. `store` must outlive the answer's use.
DiagnosisSource diagnosisSource(const RunStore& store, const RunRecord& run);

}  // namespace eyrie
