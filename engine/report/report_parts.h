#pragma once

#include "report/evaluation_report.h"
#include "report/report_page.h"

/// The chapters of a report, for its own room only.
namespace eyrie {

/// A number with so many digits behind the point.
std::string fixedDigits(double value, int decimals);

/// Curves over time and shares of objects; their pictures go into `report`.
void addFigures(ReportPage& page, const RunEvaluation& evaluation, EvaluationReportFile& report);

/// How often each kind and probable cause occurs.
void tellCauses(ReportPage& page, const RunEvaluation& evaluation, EvaluationReportFile& report);
/// The worst errors with pictures, see makeEvaluationReport().
void addChips(ReportPage& page, const RunEvaluation& evaluation, FrameSource* pixels, const ReportOptions& options,
              EvaluationReportFile& report, const std::function<void(double)>& progress, const std::stop_token& stop);
/// At most so many errors, a line each.
void listErrors(ReportPage& page, const RunEvaluation& evaluation, std::size_t most);

}  // namespace eyrie
