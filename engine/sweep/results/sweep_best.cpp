#include "sweep/results/sweep_best.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "chain/parameter_stage.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

/// How good a value is: larger is better whatever the measure.
double merit(double value, bool higher_is_better) {
    return higher_is_better ? value : -value;
}

/// Steps along an axis in one direction while values stay within the tolerance; answers the last index.
int reach(const SweepTable& table, const SweepCriterion& criterion, std::vector<int> indices, std::size_t axis,
          int step, double least_merit, bool higher_is_better) {
    const int count = static_cast<int>(table.plan.axes[axis].values.size());
    int last = indices[axis];
    for (int at = last + step; at >= 0 && at < count; at += step) {
        indices[axis] = at;
        const auto value = valueAt(table, table.plan.positionOf(indices), criterion);
        if (!value || merit(*value, higher_is_better) < least_merit) break;
        last = at;
    }
    return last;
}

BestPoint around(const SweepTable& table, const SweepCriterion& criterion, int position, double value, double tolerance,
                 bool higher_is_better) {
    BestPoint best{position, value, {}};
    const double least = merit(value, higher_is_better) - tolerance * std::abs(value);
    const std::vector<int> indices = table.plan.indicesOf(position);
    for (std::size_t a = 0; a < indices.size(); ++a) {
        best.neighbourhood.emplace_back(reach(table, criterion, indices, a, -1, least, higher_is_better),
                                        reach(table, criterion, indices, a, 1, least, higher_is_better));
    }
    return best;
}

/// How far a point lies from the middle of its neighbourhood, in steps.
int distanceFromMiddle(const SweepPlan& plan, const BestPoint& best) {
    const std::vector<int> indices = plan.indicesOf(best.position);
    int distance = 0;
    for (std::size_t a = 0; a < indices.size(); ++a)
        distance += std::abs(2 * indices[a] - best.neighbourhood[a].first - best.neighbourhood[a].second);
    return distance;
}

}  // namespace

SweepCriterion usualCriterion(const SweepPlan& plan) {
    SweepCriterion criterion;
    criterion.tracks = std::all_of(plan.axes.begin(), plan.axes.end(), [](const SweepAxis& axis) {
        return firstStageOf(axis.name) >= ChainStage::tracking;
    });
    return criterion;
}

std::string describe(const SweepCriterion& criterion, const SweepPlan& plan) {
    std::string text = measureText(criterion.key).label + " of " + (criterion.tracks ? "tracks" : "detections");
    if (criterion.overlap) return text + " at T_ov " + shortestText(*criterion.overlap);
    text += plan.overlaps.size() > 1 ? ", mean over T_ov" : " at T_ov";
    for (std::size_t i = 0; i < plan.overlaps.size(); ++i)
        text += (i > 0 ? ", " : " ") + shortestText(plan.overlaps[i]);
    return text;
}

std::optional<double> valueAt(const SweepTable& table, int position, const SweepCriterion& criterion) {
    const auto found = table.points.find(position);
    if (found == table.points.end()) return std::nullopt;
    double sum = 0;
    int count = 0;
    for (const SweepFigures& figures : found->second) {
        if (figures.tracks != criterion.tracks) continue;
        if (criterion.overlap && figures.overlap != *criterion.overlap) continue;
        if (criterion.clip && figures.clip != *criterion.clip) continue;
        const auto value = figures.at(criterion.key);
        if (!value) return std::nullopt;
        sum += *value;
        ++count;
    }
    if (count == 0) return std::nullopt;
    return sum / count;
}

std::optional<BestPoint> bestPoint(const SweepTable& table, const SweepCriterion& criterion, double tolerance) {
    const bool higher = measureText(criterion.key).higher_is_better;
    std::optional<double> highest;
    std::map<int, double> values;
    for (const auto& entry : table.points) {
        const auto value = valueAt(table, entry.first, criterion);
        if (!value) continue;
        values[entry.first] = *value;
        if (!highest || merit(*value, higher) > merit(*highest, higher)) highest = value;
    }
    std::optional<BestPoint> best;
    int distance = 0;
    for (const auto& [position, value] : values) {
        if (value != *highest) continue;
        const BestPoint candidate = around(table, criterion, position, value, tolerance, higher);
        const int from_middle = distanceFromMiddle(table.plan, candidate);
        if (best && from_middle >= distance) continue;
        best = candidate;
        distance = from_middle;
    }
    return best;
}

TradeOffCurve tradeOff(const SweepTable& table, bool tracks, double overlap, int other) {
    TradeOffCurve curve;
    const int count = static_cast<int>(table.plan.axes.front().values.size());
    for (int i = 0; i < count; ++i) {
        const int position =
            table.plan.positionOf(table.plan.axes.size() == 2 ? std::vector<int>{i, other} : std::vector<int>{i});
        const auto recall = valueAt(table, position, {"recall", tracks, overlap, {}});
        const auto precision = valueAt(table, position, {"precision", tracks, overlap, {}});
        const auto wrong = valueAt(table, position, {"fp_per_frame", tracks, overlap, {}});
        if (recall && precision && wrong) curve.points.push_back({position, *recall, *precision, *wrong});
    }
    std::map<double, double> precision_of_recall;
    for (const TradeOffPoint& point : curve.points) {
        double& precision = precision_of_recall[point.recall];
        precision = std::max(precision, point.precision);
    }
    for (auto at = precision_of_recall.begin(); at != precision_of_recall.end(); ++at) {
        const auto next = std::next(at);
        if (next == precision_of_recall.end()) break;
        curve.precision_recall_area += (next->first - at->first) * (next->second + at->second) / 2;
    }
    return curve;
}

}  // namespace eyrie
