#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/labels/box_record.h"
#include "evaluation/evaluation_options.h"

namespace eyrie {

/// One frame, sorted into what counts. Rows of `overlap` are `truth`, columns are `results`.
struct EvaluationFrame {
    FrameIndex frame = 0;
    std::vector<int> truth;                ///< indices of the true objects that count, into the frame's records
    std::vector<int> ignored_truth;        ///< indices of those that count neither way
    std::vector<int> results;              ///< indices of the results that take part
    std::vector<int> border_results;       ///< indices of those left out at the border
    std::vector<int> other_class_results;  ///< indices of those left out for their class
    std::vector<int> truth_tracks;         ///< per row: position in EvaluationInput::truth_ids
    std::vector<int> result_tracks;        ///< per column: position in EvaluationInput::result_ids
    Eigen::MatrixXd overlap;               ///< |A ∩ B| / |A ∪ B|
    std::vector<char> forgivable;          ///< per column: touches an ignored object (thesis only)
};

/// Ground truth and result brought together once; every measure is computed from this.
struct EvaluationInput {
    std::vector<EvaluationFrame> frames;  ///< ascending
    std::vector<int> truth_ids;           ///< ids of the tracks that count, ascending
    std::vector<int> result_ids;          ///< ascending
    bool has_tracks = false;              ///< every box that takes part has an id; otherwise no tracking measures
    int frame_count = 0;
    int results_not_counted = 0;  ///< results in frames outside the evaluation
    int shared_frames = 0;        ///< frames in which truth and result both have boxes
    int repeated_ids = 0;         ///< boxes whose id another box of the same frame has too
};

/// Sorts and compares. Throws Error(parameter) for bad options, Error(input) for an id that occurs twice in a frame
/// under the convention trackeval (the thesis' measures take the first).
EvaluationInput prepareEvaluation(const BoxesByFrame& truth, const BoxesByFrame& result,
                                  const EvaluationOptions& options);

}  // namespace eyrie
