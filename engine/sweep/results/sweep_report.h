#pragma once

#include <string>

#include "sweep/results/sweep_best.h"

namespace eyrie {

/// A sweep for people: one parameter as a line per value, two as a table of the criterion; then the best point.
std::string tableText(const SweepTable& table, const SweepCriterion& criterion);
/// A line per point, sequence, detections or tracks, and T_ov: the parameters' values, then every measure.
std::string csvText(const SweepTable& table);
/// Everything, with the plan, the best point and, for one parameter, precision over recall.
std::string jsonText(const SweepTable& table, const SweepCriterion& criterion);

/// "best f-score …: 0.9182 at gradient.quantile = 0.12; within 1 % of it: gradient.quantile 0.1 to 0.15".
std::string bestText(const SweepTable& table, const SweepCriterion& criterion);

}  // namespace eyrie
