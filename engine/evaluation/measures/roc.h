#pragma once

#include <vector>

namespace eyrie {

/// A sample of a test set with what the classifier says of it.
struct ScoredSample {
    double score = 0;  ///< higher is surer to be positive
    bool positive = false;
};

/// One decision threshold: samples with at least this score count as positive.
struct RocPoint {
    double threshold = 0;
    double false_positive_rate = 0;  ///< Teutsch eq. 7.3
    double true_positive_rate = 0;   ///< eq. 7.2
};

/// Receiver operating characteristic (Teutsch §7.1.1).
struct RocCurve {
    std::vector<RocPoint> points;  ///< from (0, 0), threshold +∞, to (1, 1); one for every distinct score
    double area = 0;               ///< AUC: the chance that a positive scores above a negative, ties count half
};

/// Throws Error(input) when positives or negatives are missing or a score is not a number.
RocCurve rocCurve(std::vector<ScoredSample> samples);

}  // namespace eyrie
