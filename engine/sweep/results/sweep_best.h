#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sweep/results/sweep_table.h"

namespace eyrie {

/// What a sweep is judged by: one measure of detections or tracks, mean over the sequences and, unless one is named,
/// over all T_ov, which makes the choice more robust (Teutsch §7.3.1).
struct SweepCriterion {
    std::string key = "f_score";
    bool tracks = false;
    std::optional<double> overlap;
    std::optional<int> clip;
};

/// Detections, or tracks where a swept parameter has a part in nothing before them (Teutsch §7.3.6).
SweepCriterion usualCriterion(const SweepPlan& plan);
/// "f-score of detections, mean over T_ov 0.1, 0.2, 0.3".
std::string describe(const SweepCriterion& criterion, const SweepPlan& plan);

/// Nothing where the point is missing or the measure is not defined in one of its parts.
std::optional<double> valueAt(const SweepTable& table, int position, const SweepCriterion& criterion);

/// The best point, and how far one may go from it.
struct BestPoint {
    int position = 0;
    double value = 0;
    /// Per axis, the first and last index that can be reached from the best point along this axis alone without the
    /// measure getting worse by more than the tolerance.
    std::vector<std::pair<int, int>> neighbourhood;
};
inline constexpr double kUsualTolerance = 0.01;  ///< of the best value

/// Of equal points the one in the middle of its neighbourhood. Nothing without a point.
std::optional<BestPoint> bestPoint(const SweepTable& table, const SweepCriterion& criterion,
                                   double tolerance = kUsualTolerance);

/// Precision and recall, or false alarms per frame and recall, along one axis, for a threshold that trades one for the
/// other (Teutsch fig. 7.8). Detection has no true negatives to divide by, so there is no false positive rate: false
/// alarms per frame stand in its place (free-response ROC).
struct TradeOffPoint {
    int position = 0;
    double recall = 0;
    double precision = 0;
    double false_per_frame = 0;
};
/// Precision and recall of the points of one axis.
struct TradeOffCurve {
    std::vector<TradeOffPoint> points;  ///< in the order of the axis
    /// Area under precision over the recall that was reached, by trapezoids between points in the order of recall, of
    /// equal recall the best precision; 0 with fewer than two points.
    double precision_recall_area = 0;
};
/// `other`: index on the second axis of a plan with two, whose first is followed. Means over the sequences.
TradeOffCurve tradeOff(const SweepTable& table, bool tracks, double overlap, int other = 0);

}  // namespace eyrie
