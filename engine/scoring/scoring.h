#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/evaluation_options.h"
#include "scoring/ground_truth.h"

namespace eyrie {

/// First and last frame, both included.
using ScoredFrames = std::pair<FrameIndex, FrameIndex>;

/// What results are measured against, and by which rule: all that decides a score but the result.
struct Scoring {
    GroundTruth truth;          ///< of the frames that count
    EvaluationOptions options;  ///< as boxes are compared
};

/// Derives the rule from the ground truth and what the user wishes, and says in the remarks what follows from the
/// truth: only frames that the results cover count (nothing: all), and enclosing upright boxes are compared where the
/// truth has no headings. Throws Error(input) where no box lies in those frames.
Scoring scoringOf(GroundTruth truth, const EvaluationOptions& wishes, const std::optional<ScoredFrames>& covered);

/// The frames that a run has done; it must have one.
ScoredFrames coveredFrames(const RunRecord& run);

}  // namespace eyrie
