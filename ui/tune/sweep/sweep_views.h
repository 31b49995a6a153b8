#pragma once

#include <QString>
#include <functional>
#include <optional>

#include "sweep/results/sweep_best.h"
#include "widgets/charts/sweep_chart_data.h"

namespace eyrie::ui {

/// How a sweep is looked at.
enum class SweepView {
    measure,           ///< one measure at every T_ov, or as heat map
    precision_recall,  ///< precision, recall and f-score over the parameter (fig. 7.6 a)
    trade_off,         ///< precision over recall (fig. 7.8)
    false_alarms       ///< recall over false alarms per frame
};

/// The chart of a sweep. `unit_of` gives the unit of a parameter, empty for none.
SweepChartData chartOf(const SweepTable& table, SweepView view, const SweepCriterion& criterion,
                       const std::function<QString(const std::string&)>& unit_of);

/// "gradient.quantile = 0.12: f-score 0.7461 …", one line of rich text about a point.
QString pointText(const SweepTable& table, int position, const SweepCriterion& criterion);
/// What is best and how far one may go.
QString bestPointText(const SweepTable& table, const SweepCriterion& criterion);

}  // namespace eyrie::ui
