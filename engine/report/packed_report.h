#pragma once

#include <string>

#include "report/report_file.h"

namespace eyrie {

/// A report as bytes, for another program of the same version that prints it.
std::string packReport(const ReportFile& report);
/// The report again. Throws Error(input) for bytes that are none.
ReportFile unpackReport(const std::string& bytes);

}  // namespace eyrie
