#pragma once

#include <set>
#include <utility>

#include "report/evaluation_report.h"
#include "report/report_page.h"

/// The chapters of a report, for its own room only.
namespace eyrie {

/// How wide charts are on paper.
inline constexpr double kFigureWidth_mm = 160;

/// A number with so many digits behind the point.
std::string fixedDigits(double value, int decimals);

/// Parameters of a run that differ from the default, with the default's value; answers their names.
std::set<std::string> tellDifferentParameters(ReportPage& page,
                                              const std::vector<std::pair<std::string, std::string>>& parameters);

/// Curves over time and shares of objects; their pictures go into `report`.
void addFigures(ReportPage& page, const RunEvaluation& evaluation, ReportFile& report);

/// How often each kind and probable cause occurs.
void tellCauses(ReportPage& page, const RunEvaluation& evaluation, ReportFile& report);
/// The worst errors with pictures, see makeEvaluationReport().
void addChips(ReportPage& page, const RunEvaluation& evaluation, FrameSource* pixels, const ReportOptions& options,
              ReportFile& report, const std::function<void(double)>& progress, const std::stop_token& stop);
/// At most so many errors, a line each.
void listErrors(ReportPage& page, const RunEvaluation& evaluation, std::size_t most);

}  // namespace eyrie
