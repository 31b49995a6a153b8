#pragma once

#include <stop_token>
#include <vector>

#include "core/labels/box_record.h"
#include "evaluation/evaluation_options.h"
#include "evaluation/measures/detection_measures.h"

namespace eyrie {

/// What a result is worth when only boxes with at least this score are kept.
struct ScorePoint {
    double threshold = 0;
    int tracks = 0;  ///< that are left; boxes without an id do not count
    DetectionMeasures detection;
};

/// Precision and recall over the score: a point for every distinct score of the result, ascending, so that the first
/// one is the whole result; none for an empty one. Of more than `most` scores, at least 2, so many are taken, the
/// lowest and the highest among them, with about the same number of boxes between them. A track whose states have
/// different scores loses those below. Once `stop` is requested the rest is left out. Throws as evaluate() does, and
/// Error(input) where a score is not a number.
std::vector<ScorePoint> scoreCurve(const BoxesByFrame& truth, const BoxesByFrame& result,
                                   const EvaluationOptions& options, std::size_t most = 100,
                                   const std::stop_token& stop = {});

}  // namespace eyrie
