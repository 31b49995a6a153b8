#pragma once

#include <vector>

#include "core/labels/box_record.h"
#include "evaluation/evaluation_input.h"

namespace eyrie {

/// A true object and the result that found it.
struct MatchedPair {
    int truth = 0;   ///< index into the frame's records of the ground truth
    int result = 0;  ///< index into the frame's records of the result
    double overlap = 0;
};

/// What became of every box of one frame. All numbers are indices into the frame's records as given.
struct FrameMatch {
    FrameIndex frame = 0;
    std::vector<MatchedPair> pairs;        ///< true positives; ascending `truth`
    std::vector<int> missed;               ///< false negatives
    std::vector<int> false_results;        ///< false positives
    std::vector<int> ignored_truth;        ///< objects that count neither way
    std::vector<int> ignored_results;      ///< results on such objects
    std::vector<int> border_results;       ///< results left out at the border
    std::vector<int> other_class_results;  ///< results left out for their class
};

/// Decides frame by frame which result found which object (Teutsch §7.1.1, fig. 7.2; conventions: see Convention).
std::vector<FrameMatch> matchFrames(const EvaluationInput& input, const EvaluationOptions& options);

/// The same from the boxes.
std::vector<FrameMatch> matchFrames(const BoxesByFrame& truth, const BoxesByFrame& result,
                                    const EvaluationOptions& options);

/// One-to-one pairs, none below `threshold`, with the largest sum of 1 + overlap, so that in small groups the number of
/// pairs comes before their quality: the column of every row of `overlap`, −1 where there is none.
std::vector<int> matchByOverlap(const Eigen::MatrixXd& overlap, double threshold);

}  // namespace eyrie
