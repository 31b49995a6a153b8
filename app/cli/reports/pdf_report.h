#pragma once

#include <filesystem>
#include <stop_token>

#include "report/report_file.h"

namespace eyrie::cli {

/// Throws Error(output) where a report should be PDF and the program of the window, which writes them, does not lie
/// beside this one. To be asked before the work.
void checkReportCanBeWritten(const std::filesystem::path& out);
/// Writes a report as its name says. Throws Error(output). Answers false where `stop` ended it. Unless it is whole,
/// what was there stays, and nothing is left beside it.
bool writeReport(const std::filesystem::path& out, const ReportFile& report, const std::stop_token& stop);

}  // namespace eyrie::cli
